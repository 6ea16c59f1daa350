// Emission alone: 2^exposure int C ds, added to what is behind.
// Uses: segment.
#include "lib/layer_uniforms.glsl"

struct RayState {
    MapCursor cursor;
    vec3 light;  // int C ds so far
};

RayState beginRay(Ray ray) {
    return RayState(noCursor(), vec3(0.0));
}

void enterData(inout RayState state, Segment piece) {
    placeCursor(state.cursor, piece);
}

bool stepRay(inout RayState state, inout Segment rest) {
    state.light += integrateSegment(state.cursor, rest).rgb;
    return false;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return false;
}

vec4 endRay(RayState state, float facing) {
    return vec4(layer.gather.y * state.light, 0.0);
}

float hitDistance(RayState state) {
    return kNoHit;
}

vec4 packRay(RayState state) {
    return vec4(state.light, 0.0);
}

RayState unpackRay(vec4 stored) {
    return RayState(noCursor(), stored.rgb);
}
