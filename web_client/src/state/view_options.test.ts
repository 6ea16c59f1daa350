import { expect, it } from "vitest";
import { kUsualOptions, readOptions, switched } from "./view_options";

it("reads what was kept and ignores what is odd", () => {
  const other = switched(switched(kUsualOptions, "box"), "axes");
  expect(other).toMatchObject({ box: true, axes: false, scaleBar: true });
  expect(readOptions(JSON.stringify(other))).toEqual(other);
  for (const text of [null, "", "[", "3", "null", '{"box":"yes","else":true}']) {
    expect(readOptions(text)).toEqual(kUsualOptions);
  }
});
