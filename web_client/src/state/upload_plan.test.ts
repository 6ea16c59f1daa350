import { describe, expect, it } from "vitest";
import { isData, uploadName, uploadProblem } from "./upload_plan";

const files = (...names: string[]) => names.map((name) => ({ name, size: 10 }));

describe("an upload's name", () => {
  it.each([
    [files("cube.node", "cube.ele"), undefined, "cube"],
    [files("slice_001.tif", "slice_002.tif", "slice_010.tif"), undefined, "slice"],
    [files("ball.mhd", "ball.raw"), undefined, "ball"],
    [files("brain.nii.gz"), undefined, "brain"],
    [files("a.vtu", "z.vtu"), undefined, "a"],
    [files("run 12.vtu", "run 13.vtu"), undefined, "run"],
    [files("1.png", "2.png"), "scan", "scan"],
    [files("1.png"), "../x", "_x"],
    [[], undefined, "data"],
  ])("of %j in %s is %s", (of, folder, name) => {
    expect(uploadName(of, folder)).toBe(name);
  });
});

describe("what can be sent", () => {
  const limits = { maxBytes: 25, maxFiles: 3 };

  it("is within the server's limits, not empty and told apart by name", () => {
    expect(uploadProblem(files("a", "b"), limits)).toBeUndefined();
    expect(uploadProblem([], limits)).toMatch(/no file/);
    expect(uploadProblem(files("a", "b", "c", "d"), limits)).toMatch(/4 files; .* 3 at once/);
    expect(uploadProblem(files("a", "b", "c"), limits)).toMatch(/30 B; .* 25 B/);
    expect(uploadProblem([{ name: "a.vtu", size: 0 }], limits)).toMatch(/a\.vtu is empty/);
    expect(uploadProblem(files("a", "a"), limits)).toMatch(/two files called a/);
    expect(uploadProblem(files("ö".repeat(101)), limits)).toMatch(/too long/);
  });

  it("is not what systems leave in folders", () => {
    expect([".DS_Store", "Thumbs.db", "desktop.ini", "a.vtu"].filter(isData)).toEqual(["a.vtu"]);
  });
});
