import { describe, expect, it } from "vitest";
import { accessIn } from "./access";

describe("accessIn", () => {
  it("finds the token and leaves all else as it is", () => {
    expect(accessIn("#link=L-1_x&access=A-2_y&apart")).toEqual({
      access: "A-2_y",
      rest: "#link=L-1_x&apart",
    });
    expect(accessIn("#access=A")).toEqual({ access: "A", rest: "" });
  });

  it("is without one where there is none", () => {
    expect(accessIn("")).toEqual({ access: undefined, rest: "" });
    expect(accessIn("#view=access=")).toEqual({ access: undefined, rest: "#view=access=" });
  });
});
