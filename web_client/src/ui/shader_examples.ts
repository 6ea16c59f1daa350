export interface ShaderExample {
  readonly name: string;
  readonly code: string;
}

/** Code to start from: one for each kind of control, and one with all that a first try needs. */
export const kShaderExamples: readonly ShaderExample[] = [
  {
    name: "Tinted range",
    code: `#uicontrol invlerp range
#uicontrol vec3 tint color(default="#ffd080")
#uicontrol float opacity slider(min=0, max=1, default=0.3)

void main() {
  float x = range();
  emitRGBA(vec4(tint * x, opacity * x));
}
`,
  },
  {
    name: "invlerp: two values that become 0 and 1",
    code: `// Drag both ends; a range that is turned round turns the picture round.
#uicontrol invlerp normalized

void main() {
  emitGrayscale(normalized());
}
`,
  },
  {
    name: "transferFunction: colours and opacities by points",
    code: `// Click adds a point, drag moves it, double click deletes it.
#uicontrol transferFunction map(controlPoints=[[0.2, "#000040", 0], [0.6, "#ff8000", 0.2], [1, "#ffffff", 0.8]])

void main() {
  emitRGBA(map());
}
`,
  },
  {
    name: "slider: a number",
    code: `#uicontrol invlerp range
#uicontrol float contrast slider(min=0.1, max=8, default=2, step=0.1)
#uicontrol float opacity slider(min=0, max=1, default=0.4)

void main() {
  float x = pow(range(), contrast);
  emitRGBA(vec4(vec3(x), opacity * x));
}
`,
  },
  {
    name: "color: a colour",
    code: `#uicontrol invlerp range
#uicontrol vec3 low color(default="#2040ff")
#uicontrol vec3 high color(default="#ffe060")

void main() {
  float x = range();
  emitRGBA(vec4(mix(low, high, x), 0.4 * x));
}
`,
  },
  {
    name: "checkbox: yes or no",
    code: `// A checkbox is a constant of the code: a change compiles it again.
#uicontrol invlerp range
#uicontrol bool inverted checkbox(default=false)

void main() {
  float x = inverted ? 1.0 - range() : range();
  emitRGBA(vec4(vec3(x), 0.4 * x));
}
`,
  },
  {
    name: "select: one of a few",
    code: `#uicontrol invlerp range
#uicontrol int bands select(options={"Smooth": 0, "Four bands": 4, "Eight bands": 8})

void main() {
  float x = range();
  if (bands > 0) {
    x = floor(x * float(bands)) / float(bands);
  }
  emitRGBA(vec4(x, 0.5, 1.0 - x, 0.4 * x));
}
`,
  },
];
