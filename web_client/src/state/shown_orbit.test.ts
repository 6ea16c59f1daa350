import { expect, it } from "vitest";
import { dragged, type Orbit } from "../view/camera";
import { createAppState, type PictureInfo } from "./app_state";
import { followShownOrbit } from "./shown_orbit";

const first: Orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0,
  pitch: 0,
  distance: 5,
  fovyDegrees: 35,
  orthographic: false,
};

it("is the camera of the picture, not the newest one", () => {
  const state = createAppState();
  const shown = followShownOrbit(state);
  const picture = (inputSeq: bigint): void => {
    state.picture.value = { inputSeq } as PictureInfo;
  };
  state.newestInput.value = 1n; // The view is opened; its camera comes with it.
  state.orbit.value = first;
  shown.opened();
  picture(1n);
  expect(state.shownOrbit.value).toBe(first);

  const second = dragged(first, 10, 0, 0.01);
  state.orbit.value = second;
  state.newestInput.value = 2n;
  state.orbit.value = dragged(second, 10, 0, 0.01);
  expect(state.shownOrbit.value).toBe(first);
  picture(2n);
  expect(state.shownOrbit.value).toBe(second);

  picture(7n); // Of an update that this page did not send.
  expect(state.shownOrbit.value).toBe(state.orbit.value);
});
