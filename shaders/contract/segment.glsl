// The share of one cell or one sample in a ray, passed front to back from evaluator to model.
//
// f is the field that gives colours, g the one that gives extinctions; they are the same where the
// layer names one. Values are those of the layer's scale.
//
// Slots and their functions, in the order in which a program holds them:
//   classify   vec4 classify(float f)                          rgb: linear colour, a: extinction
//              vec4 matterAt(float f, float g)                 C(f), rho(g)
//              bool transparentBetween(float lo, float hi)     no extinction anywhere in [lo, hi]
//   segment    vec4 integrateSegment(inout MapCursor cursor, inout Segment rest)
//                         takes the front part of `rest` or all of it; what it returns belongs to
//                         the model: volume: premultiplied colour and opacity; xray, splat: the
//                         integrals of C and rho
//   model      struct RayState
//              RayState beginRay(Ray ray)
//              void enterData(inout RayState state, Segment piece)
//                         before a piece whose front values do not continue the piece before
//              bool stepRay(inout RayState state, inout Segment rest)
//                         takes the front part of `rest` or all of it; rest.extent is what is left,
//                         < 0 where all was taken; true: nothing behind can show
//              bool skipsBetween(RayState state, float lo, float hi)
//                         true: values in [lo, hi] would leave the state as it is
//              vec4 endRay(RayState state, float facing)       premultiplied colour and opacity;
//                         facing: |cosine| between the ray and the gradient of f where it ended
//              float hitDistance(RayState state)               of opaque models; huge: no hit
//              vec4 packRay(RayState state), RayState unpackRay(vec4 stored)
//                         for evaluators that blend the states of single pieces
//   evaluator  void main(): where the ray goes; writes the model's answer
struct Segment {
    float front;  // f where the ray enters
    float back;   // f where it leaves
    float densityFront;  // g there
    float densityBack;
    float extent;    // length in world units, >= 0; glslang takes a member .length for a call
    float distance;  // from the ray's origin to the front end, world units
};

// While an evaluator sets this, integrateSegment may leave a piece as it is instead of taking a part.
bool wholePieces = false;

const float kNoHit = 3.0e38;
