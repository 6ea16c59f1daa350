// The share of one cell or one sample in a ray, passed front to back from evaluator to model.
//
// Slots and their functions, in the order in which a program holds them:
//   classify   vec4 classify(float value)                      rgb: linear colour, a: extinction
//              bool transparentBetween(float lo, float hi)     no extinction anywhere in [lo, hi]
//   segment    vec4 integrateSegment(Segment piece)            premultiplied colour and opacity
//   model      struct RayState
//              RayState beginRay(Ray ray)
//              bool stepRay(inout RayState state, Segment piece)   true: nothing behind can show
//              bool skipsBetween(RayState state, float lo, float hi)
//                         true: values in [lo, hi] would leave the state as it is
//              vec4 endRay(RayState state)                     premultiplied colour and opacity
//   evaluator  void main(): where the ray goes; writes the model's answer
struct Segment {
    float front;     // value where the ray enters
    float back;      // value where it leaves
    float extent;    // length in world units, >= 0; glslang takes a member .length for a call
    float distance;  // from the ray's origin to the front end, world units
};
