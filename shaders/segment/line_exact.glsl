// Integrals of C and rho along a piece, split at the map's control points: trapezoids. A difference
// of the map's integrals would lose all digits where both ends are close.
// Uses: classify.
#include "lib/map_cursor.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    if (wholePieces) {
        vec4 mean = 0.5 * (matterIn(cursor, rest.front, rest.densityFront) +
                           matterIn(cursor, rest.back, rest.densityBack));
        bool whole = isLinear(cursor, rest);
        vec4 integral = mean * (whole ? rest.extent : 0.0);
        rest.extent = whole ? -1.0 : rest.extent;
        return integral;
    }
    LinearPart part = linearPart(cursor, rest);
    takePart(cursor, rest, part);
    return 0.5 * (part.first + part.last) * part.extent;
}
