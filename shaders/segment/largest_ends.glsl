// The largest red, green and blue at both ends of pieces; misses what the map does between.
// Uses: classify.
#include "lib/map_cursor.glsl"

struct Extreme {
    vec3 colour;
};

Extreme noExtreme() {
    return Extreme(vec3(-3.0e38));
}

// The values in hand do not go on from here.
void settleExtreme(inout Extreme extreme, MapCursor cursor) {
    extreme.colour = max(extreme.colour, cursor.matter.rgb);
}

void integrateSegment(inout MapCursor cursor, inout Extreme extreme, inout Segment rest) {
    takeAll(cursor, rest, classify(rest.back));
    extreme.colour = max(extreme.colour, cursor.matter.rgb);
}

vec3 largestColour(Extreme extreme) {
    return extreme.colour;
}
