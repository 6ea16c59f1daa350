// The largest red, green and blue of the field's colours on the ray, each by itself. Opaque where
// the ray met data.
// Uses: classify, segment.
struct RayState {
    MapCursor cursor;
    Extreme extreme;
    bool met;
};

RayState beginRay(Ray ray) {
    return RayState(noCursor(), noExtreme(), false);
}

void enterData(inout RayState state, Segment piece) {
    placeCursor(state.cursor, piece);
    settleExtreme(state.extreme, state.cursor);
}

bool stepRay(inout RayState state, inout Segment rest) {
    integrateSegment(state.cursor, state.extreme, rest);
    state.met = true;
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return false;
}

vec4 endRay(RayState state, float facing) {
    return state.met ? vec4(largestColour(state.extreme), 1.0) : vec4(0.0);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return vec4(largestColour(state.extreme), state.met ? 1.0 : -3.0e38);
}

RayState unpackRay(vec4 stored) {
    Extreme extreme = noExtreme();
    extreme.colour = stored.rgb;
    return RayState(noCursor(), extreme, stored.a > 0.0);
}
