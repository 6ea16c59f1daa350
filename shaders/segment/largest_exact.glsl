// The largest red, green and blue anywhere in pieces: at both ends and at every control point
// between. Pieces that go on from each other cover one range of values, so that range is kept and
// the map asked once at its end: the largest of any run of points is that of two runs of a table.
// Source of the table: M. Bender, M. Farach-Colton, The LCA Problem Revisited, LATIN 2000.
// Uses: classify.
#include "lib/map_cursor.glsl"

struct Extreme {
    vec3 colour;  // of the ranges before
    float low;    // of the range in hand; empty where low > high
    float high;
};

Extreme noExtreme() {
    return Extreme(vec3(-3.0e38), 3.4e38, -3.4e38);
}

// The largest colour of the points from `first` to `last`.
vec3 largestOfPoints(int first, int last) {
    int level = findMSB(last - first + 1);
    int row = int(mapSections.z) + level * int(mapHead.grid.x);
    return max(texelFetch(mapTexels, row + first).rgb,
               texelFetch(mapTexels, row + last + 1 - (1 << level)).rgb);
}

vec3 largestColour(Extreme extreme) {
    if (extreme.low > extreme.high) return extreme.colour;
    int first = pointsUpTo(extreme.low);
    int last = pointsUpTo(extreme.high) - 1;
    vec3 colour = max(extreme.colour, max(classify(extreme.low).rgb, classify(extreme.high).rgb));
    return last >= first ? max(colour, largestOfPoints(first, last)) : colour;
}

// The values in hand do not go on from here.
void settleExtreme(inout Extreme extreme, MapCursor cursor) {
    extreme = Extreme(largestColour(extreme), 3.4e38, -3.4e38);
}

void integrateSegment(inout MapCursor cursor, inout Extreme extreme, inout Segment rest) {
    extreme.low = min(extreme.low, min(rest.front, rest.back));
    extreme.high = max(extreme.high, max(rest.front, rest.back));
    rest.extent = -1.0;
}
