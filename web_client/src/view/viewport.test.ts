import { describe, expect, it } from "vitest";
import { devicePixels, limited } from "./viewport";

describe("viewport size", () => {
  it("keeps device pixels within the server's limit, and their ratio beyond it", () => {
    expect(limited(1280, 800, 8192)).toEqual({ width: 1280, height: 800 });
    expect(limited(16384, 4096, 8192)).toEqual({ width: 8192, height: 2048 });
    expect(limited(100000, 1, 8192)).toEqual({ width: 8192, height: 1 });
    expect(limited(0, 0, 8192)).toEqual({ width: 1, height: 1 });
  });

  it("takes the layout's exact pixels, unless they are of another screen", () => {
    expect(devicePixels(333.4, 1.5, 501)).toBe(501);
    expect(devicePixels(465, 2, 465)).toBe(930);
    expect(devicePixels(100.3, 2, undefined)).toBe(201);
  });
});
