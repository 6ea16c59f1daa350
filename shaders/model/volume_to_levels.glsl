// A volume and the isosurfaces in it, in one walk: the nearest level ends the ray and shows through
// what lies before it.
// Constants: kLit: levels are lit from the eye.
// Uses: classify, segment.
#include "lib/finished.glsl"
#include "lib/levels.glsl"

struct RayState {
    MapCursor cursor;
    LevelCursor levels;
    vec3 colour;    // premultiplied, linear
    float opacity;  // of all pieces so far
    int level;      // that ends the ray with the piece in hand; -1: none yet
    float distance;
};

RayState beginRay(Ray ray) {
    return RayState(noCursor(), LevelCursor(0, -3.4e38, 3.4e38), vec3(0.0), 0.0, -1, kNoHit);
}

void enterData(inout RayState state, Segment piece) {
    placeCursor(state.cursor, piece);
    state.levels = placeAmongLevels(piece.front);
}

bool stepRay(inout RayState state, inout Segment rest) {
    // Cut at the level once; what is left of the piece then ends on it.
    LevelHit hit = firstLevel(state.levels, rest);
    if (hit.met && state.level < 0) {
        rest.densityBack = mix(rest.densityFront, rest.densityBack, hit.share);
        rest.back = hit.value;
        rest.extent *= hit.share;
        state.level = hit.index;
    }
    float end = rest.distance + rest.extent;
    vec4 share = integrateSegment(state.cursor, rest);
    float through = 1.0 - state.opacity;
    state.colour += through * share.rgb;
    state.opacity += through * share.a;
    bool reached = state.level >= 0 && rest.extent < 0.0;
    state.distance = reached ? end : kNoHit;
    return reached || state.opacity > kFinishedOpacity;
}

bool skipsBetween(RayState state, float lo, float hi) {
    return false;
}

vec4 endRay(RayState state, float facing) {
    if (state.distance >= kNoHit) return vec4(state.colour, state.opacity);
    vec3 surface = levelAt(state.level).yzw * (kLit ? facing : 1.0);
    return vec4(state.colour + (1.0 - state.opacity) * surface, 1.0);
}

float hitDistance(RayState state) {
    return state.distance;
}

vec4 packRay(RayState state) {
    return vec4(state.colour, state.opacity);
}

RayState unpackRay(vec4 stored) {
    RayState state = beginRay(Ray(vec3(0.0), vec3(0.0)));
    state.colour = stored.rgb;
    state.opacity = stored.a;
    return state;
}
