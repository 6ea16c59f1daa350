// A volume of one colour: only how much of it lies on the ray counts, which needs no order.
// Uses: classify, segment (the integral of rho).
#include "lib/finished.glsl"
#include "lib/opacity.glsl"

struct RayState {
    MapCursor cursor;
    float depth;  // int rho ds so far
};

RayState beginRay(Ray ray) {
    return RayState(noCursor(), 0.0);
}

void enterData(inout RayState state, Segment piece) {
    placeCursor(state.cursor, piece);
}

bool stepRay(inout RayState state, inout Segment rest) {
    state.depth += integrateSegment(state.cursor, rest).a;
    return state.depth > kFinishedDepth;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return transparentBetween(lo, hi);
}

vec4 endRay(RayState state, float facing) {
    float opacity = opacityOf(state.depth);
    return vec4(classify(0.0).rgb * opacity, opacity);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return vec4(state.depth);
}

RayState unpackRay(vec4 stored) {
    return RayState(noCursor(), stored.r);
}
