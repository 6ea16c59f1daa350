// One piece as a user's code shows it: constant, with the opacity that the code gives for the
// reference distance, corrected for the piece's own length.
// Uses: classify (user_code.glsl).
#include "lib/opacity_correction.glsl"

struct MapCursor {
    int unused;
};

MapCursor noCursor() {
    return MapCursor(0);
}

void placeCursor(inout MapCursor cursor, Segment piece) {
}

float referencesAWorldUnit = codeHeader.x;

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 colour = emissionAt(0.5 * (rest.front + rest.back)).colour;
    float opacity = correctedOpacity(colour.a, referencesAWorldUnit * rest.extent);
    rest.extent = -1.0;
    return vec4(opacity * colour.rgb, opacity);
}
