// Maximum intensity: the largest value on the ray first, then its colour. C(max f) is not
// max C(f). Opaque where the ray met data.
// Uses: classify.
struct RayState {
    float largest;
    bool met;
};

const float kNothing = -3.4e38;

RayState beginRay(Ray ray) {
    return RayState(kNothing, false);
}

void enterData(inout RayState state, Segment piece) {
}

bool stepRay(inout RayState state, inout Segment rest) {
    state.largest = max(state.largest, max(rest.front, rest.back));
    state.met = true;
    rest.extent = -1.0;
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return hi <= state.largest;
}

vec4 endRay(RayState state, float facing) {
    return state.met ? vec4(classify(state.largest).rgb, 1.0) : vec4(0.0);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return vec4(state.largest);
}

RayState unpackRay(vec4 stored) {
    return RayState(stored.r, stored.r > kNothing);
}
