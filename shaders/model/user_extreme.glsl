// Maximum or minimum intensity by a user's code: the colour of the sample that has it. Intensities
// go from 0 to 1, where the code names one; nothing shows at 0 of a maximum and at 1 of a minimum.
// Constants: kLargestCounts.
// Uses: classify (user_code.glsl).
struct RayState {
    vec4 colour;  // of the sample that counts, not premultiplied
    float intensity;
};

RayState beginRay(Ray ray) {
    return RayState(vec4(0.0), kLargestCounts ? -3.4e38 : 3.4e38);
}

void enterData(inout RayState state, Segment piece) {
}

bool stepRay(inout RayState state, inout Segment rest) {
    float extent;
    Emission sampled = takeSample(rest, extent);
    bool shows = !sampled.rated ||
                 (kLargestCounts ? sampled.intensity > 0.0 : sampled.intensity < 1.0);
    bool beats = kLargestCounts ? sampled.intensity > state.intensity
                                : sampled.intensity < state.intensity;
    if (shows && beats) {
        state.colour = sampled.colour;
        state.intensity = sampled.intensity;
    }
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return false;
}

vec4 endRay(RayState state, float facing) {
    return vec4(state.colour.rgb * state.colour.a, state.colour.a);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return state.colour;
}

RayState unpackRay(vec4 stored) {
    return RayState(stored, 0.0);
}
