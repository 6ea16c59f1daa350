// A piece as a user's code shows it at its samples: each stands for a part, of the opacity that the code
// gives for the reference distance, corrected for the length of the part.
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
    float extent;
    vec4 colour = takeSample(rest, extent).colour;
    float opacity = correctedOpacity(colour.a, referencesAWorldUnit * extent);
    return vec4(opacity * colour.rgb, opacity);
}
