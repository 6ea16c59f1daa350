// What a user's code is told of the sample that it is called for, and what it answers.
//
// An evaluator defines these; channel -1 is the layer's own field:
//   float nearestValue(int channel)       of the nearest voxel; in a mesh as the next
//   float interpolatedValue(int channel)  between voxels; in a cell
//   float sampledValue(int channel)       as the layer asks for
//   float sampleExtent(float extent)      how much of the front of a piece one sample stands for
//   float placeSample(float value, float distance)  the sample is there, where the piece has `value`;
//                                         returns that as it is stored
// A program holds, in this order: user/values.glsl, what is generated of the data's type,
// user/controls.glsl, what is generated of the controls, the user's code with all of its names
// beginning with `user`, and user/sample.glsl.
float nearestValue(int channel);
float interpolatedValue(int channel);
float sampledValue(int channel);
float sampleExtent(float extent);
float placeSample(float value, float distance);

const int kOwnChannel = -1;

struct Emission {
    vec4 colour;      // linear, not premultiplied; a: opacity of a reference distance
    float intensity;  // what MAX and MIN compare
    bool rated;       // the code has given an intensity
    float looked;     // from 0 to 1: where the last invlerp or transferFunction saw the value
    bool hasLooked;
};

Emission emission;
