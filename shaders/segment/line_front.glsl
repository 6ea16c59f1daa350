// Integrals of C and rho along a piece, as if it were all like its front end.
// Uses: classify.
#include "lib/map_cursor.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 integral = matterAt(rest.front, rest.densityFront) * rest.extent;
    rest.extent = -1.0;
    return integral;
}
