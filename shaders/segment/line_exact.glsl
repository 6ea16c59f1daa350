// Integrals of C and rho along a piece, split at the map's control points: trapezoids. A difference
// of the map's integrals would lose all digits where both ends are close.
// Uses: classify.
#include "lib/map_cursor.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    LinearPart part = linearPart(cursor, rest);
    takePart(cursor, rest, part);
    return 0.5 * (part.first + part.last) * part.extent;
}
