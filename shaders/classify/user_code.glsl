// A user's code in the place of a map. Nobody knows without running it what it shows of a value.
#include "user/code.glsl"

vec4 classify(float f) {
    return emission.colour;
}

vec4 matterAt(float f, float g) {
    return emission.colour;
}

bool transparentBetween(float lo, float hi) {
    return false;
}

// Takes the front part of `rest` that one sample stands for, of length `extent`, and asks the code in
// its middle.
Emission takeSample(inout Segment rest, out float extent) {
    extent = sampleExtent(rest.extent);
    float share = extent < rest.extent ? extent / rest.extent : 1.0;
    float value = mix(rest.front, rest.back, 0.5 * share);
    value = placeSample(value, rest.distance + 0.5 * extent);
    rest.front = mix(rest.front, rest.back, share);
    rest.distance += extent;
    rest.extent = share < 1.0 ? rest.extent - extent : -1.0;
    return emissionAt(value);
}
