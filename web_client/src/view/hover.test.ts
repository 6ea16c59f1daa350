import { expect, it } from "vitest";
import { pixelAt } from "./hover";

it("finds the pixel that a pointer is over", () => {
  expect(pixelAt({ x: 0, y: 0 }, 640, 480)).toEqual({ x: 0, y: 0 });
  expect(pixelAt({ x: 0.5, y: 0.999 }, 640, 480)).toEqual({ x: 320, y: 479 });
  expect(pixelAt({ x: 1, y: 0.5 }, 640, 480)).toBeUndefined();
  expect(pixelAt({ x: 0.5, y: -0.01 }, 640, 480)).toBeUndefined();
});
