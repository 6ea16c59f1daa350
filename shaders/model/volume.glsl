// Emission and absorption, front to back: each piece adds its light through what lies before it.
// Source: N. Max, Optical Models for Direct Volume Rendering, IEEE TVCG 1(2), 1995, section 4.
// Uses: classify, segment.
#include "lib/finished.glsl"

struct RayState {
    MapCursor cursor;
    vec3 colour;    // premultiplied, linear
    float opacity;  // of all pieces so far
};

RayState beginRay(Ray ray) {
    return RayState(noCursor(), vec3(0.0), 0.0);
}

void enterData(inout RayState state, Segment piece) {
    placeCursor(state.cursor, piece);
}

bool stepRay(inout RayState state, inout Segment rest) {
    vec4 share = integrateSegment(state.cursor, rest);
    float through = 1.0 - state.opacity;
    state.colour += through * share.rgb;
    state.opacity += through * share.a;
    return state.opacity > kFinishedOpacity;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return transparentBetween(lo, hi);
}

vec4 endRay(RayState state, float facing) {
    return vec4(state.colour, state.opacity);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return vec4(state.colour, state.opacity);
}

RayState unpackRay(vec4 stored) {
    return RayState(noCursor(), stored.rgb, stored.a);
}
