// Integrals of C and rho along a piece by the mean of both ends; misses what the map does between.
// Uses: classify.
#include "lib/map_cursor.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 back = matterAt(rest.back, rest.densityBack);
    vec4 integral = 0.5 * (cursor.matter + back) * rest.extent;
    takeAll(cursor, rest, back);
    return integral;
}
