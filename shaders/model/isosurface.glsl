// The nearest point whose value is one of the levels, in the level's colour or in that of g there.
// Constants: kLit: under a light at the eye; kTwoMaps: coloured by g.
// Uses: classify.
#include "lib/levels.glsl"

struct RayState {
    LevelCursor cursor;
    int level;  // that was hit; -1: none
    float g;    // there
    float distance;
};

RayState beginRay(Ray ray) {
    return RayState(LevelCursor(0, -3.4e38, 3.4e38), -1, 0.0, kNoHit);
}

void enterData(inout RayState state, Segment piece) {
    state.cursor = placeAmongLevels(piece.front);
}

bool stepRay(inout RayState state, inout Segment rest) {
    LevelHit hit = firstLevel(state.cursor, rest);
    state.level = hit.met ? hit.index : -1;
    state.g = mix(rest.densityFront, rest.densityBack, hit.share);
    state.distance = rest.distance + hit.share * rest.extent;
    rest.extent = -1.0;
    return hit.met;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return lo >= state.cursor.below && hi < state.cursor.above;
}

vec4 endRay(RayState state, float facing) {
    if (state.level < 0) return vec4(0.0);
    return vec4(levelColour(state.level, state.g) * (kLit ? facing : 1.0), 1.0);
}

float hitDistance(RayState state) {
    return state.level < 0 ? kNoHit : state.distance;
}

vec4 packRay(RayState state) {
    return vec4(0.0);  // Hits are drawn as they are found, the nearest wins by depth.
}

RayState unpackRay(vec4 stored) {
    return beginRay(Ray(vec3(0.0), vec3(0.0)));
}
