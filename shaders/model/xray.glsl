// X-ray: white light through what absorbs, exp(-k int rho ds). 1 where nothing does.
// Uses: segment.
#include "lib/layer_uniforms.glsl"

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
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return transparentBetween(lo, hi);
}

vec4 endRay(RayState state, float facing) {
    return vec4(vec3(exp(-layer.gather.x * state.depth)), 1.0);
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
