// Split at the map's control points: in each part colour and extinction are linear, and the part's
// integral is exact. Parts are cut at an optical depth of 1/2, where a short series is as good as
// the closed form for any depth and costs a fifth of it. Most cells need neither.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, IEEE
// VolVis 2004 (the integral), and P. Williams, N. Max, C. Stein, A High Accuracy Volume Renderer for
// Unstructured Data, IEEE TVCG 4(1), 1998 (the splitting).
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/psi_short.glsl"

const float kDeepestPart = 0.5;

vec4 integrateWhole(MapCursor cursor, inout Segment rest) {
    float front = matterIn(cursor, rest.front, rest.densityFront).a * rest.extent;
    float back = matterIn(cursor, rest.back, rest.densityBack).a * rest.extent;
    bool whole = isLinear(cursor, rest) && front <= kDeepestPart && back <= kDeepestPart;
    float a = min(front, kDeepestPart);
    float b = min(back, kDeepestPart);
    vec2 share = psiShort(0.5 * (a + b), 0.5 * (b - a));
    if (!whole) share = vec2(0.0);
    float middle = 0.5 * (rest.front + rest.back) - cursor.piece.from;
    float f = share.x * middle + share.y * (rest.back - rest.front);
    rest.extent = whole ? -1.0 : rest.extent;
    return vec4(share.x * cursor.piece.start.rgb + f * cursor.piece.slope.rgb, share.x);
}

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    if (wholePieces) return integrateWhole(cursor, rest);
    LinearPart part = linearPart(cursor, rest);
    float deepest = max(part.first.a, part.last.a) * part.extent;
    if (deepest > kDeepestPart) shorten(part, rest, kDeepestPart / deepest);
    float front = part.first.a * part.extent;
    float back = part.last.a * part.extent;
    vec2 share = psiShort(0.5 * (front + back), 0.5 * (back - front));
    takePart(cursor, rest, part);
    return vec4(0.5 * share.x * (part.first.rgb + part.last.rgb) +
                share.y * (part.last.rgb - part.first.rgb), share.x);
}
