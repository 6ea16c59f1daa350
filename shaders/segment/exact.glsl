// Split at the map's control points: in each part colour and extinction are linear, and the part's
// integral is exact. Parts are cut at an optical depth of 1/2, where a short series is as good as
// the closed form for any depth and costs a fifth of it.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, IEEE
// VolVis 2004 (the integral), and P. Williams, N. Max, C. Stein, A High Accuracy Volume Renderer for
// Unstructured Data, IEEE TVCG 4(1), 1998 (the splitting).
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/psi_short.glsl"

const float kDeepestPart = 0.5;

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    LinearPart part = linearPart(cursor, rest);
    float deepest = max(part.first.a, part.last.a) * part.extent;
    if (deepest > kDeepestPart) shorten(part, rest, kDeepestPart / deepest);
    float front = part.first.a * part.extent;
    float back = part.last.a * part.extent;
    float sum = front + back;
    vec2 share = psiShort(0.5 * sum, sum > 0.0 ? (back - front) / sum : 0.0);
    takePart(cursor, rest, part);
    return vec4(mix(part.first.rgb, part.last.rgb, share.x) * share.y, share.y);
}
