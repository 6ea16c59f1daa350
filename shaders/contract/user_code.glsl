// What a user's code is told of the sample that it is called for, and what it answers.
//
// An evaluator defines these; channel -1 is the layer's own field:
//   float nearestValue(int channel)       of the nearest voxel; of a cell
//   float interpolatedValue(int channel)  between voxels
//   float sampledValue(int channel)       as the layer asks for
// A program holds, in this order: user/values_*.glsl (the type of the data), user/controls.glsl, what
// is generated of the controls, the user's code with all of its names beginning with `user`, and
// user/sample.glsl.
float nearestValue(int channel);
float interpolatedValue(int channel);
float sampledValue(int channel);

const int kOwnChannel = -1;

struct Emission {
    vec4 colour;      // linear, not premultiplied; a: opacity of a reference distance
    float intensity;  // what MAX and MIN compare
    bool rated;       // the code has given an intensity
    float looked;     // from 0 to 1: where the last invlerp or transferFunction saw the value
    bool hasLooked;
};

Emission emission;

const bool VOLUME_RENDERING = true;
