// Maximum intensity: the largest value on the ray first, then its colour. C(max f) is not
// max C(f). Opaque where the ray met data.
// Uses: classify.
struct RayState {
    float largest;
    bool met;
};

RayState beginRay(Ray ray) {
    return RayState(-3.4e38, false);
}

bool stepRay(inout RayState state, Segment piece) {
    state.largest = max(state.largest, max(piece.front, piece.back));
    state.met = true;
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return hi <= state.largest;
}

vec4 endRay(RayState state) {
    return state.met ? vec4(classify(state.largest).rgb, 1.0) : vec4(0.0);
}
