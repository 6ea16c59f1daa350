// Any triangle in the picture, also where the plane of the eye cuts it.
#include "mesh/outline.glsl"

void include(vec2 at, inout vec2 low, inout vec2 high) {
    low = min(low, at);
    high = max(high, at);
}

// Where an edge crosses the plane of the eye it runs out of the picture on the side where it is
// then; on both where rounding leaves that open.
void includeCrossing(vec4 p, vec4 q, inout vec2 low, inout vec2 high) {
    if ((p.w > 0.0) == (q.w > 0.0)) return;
    vec2 at = mix(p.xy, q.xy, clamp(p.w / (p.w - q.w), 0.0, 1.0));
    vec2 doubt = 1.0e-6 * max(abs(p.xy), abs(q.xy));
    low = min(low, mix(vec2(2.0), vec2(-2.0), lessThan(at, doubt)));
    high = max(high, mix(vec2(-2.0), vec2(2.0), greaterThan(at, -doubt)));
}

// Corner `turn` of a triangle over all of the picture that a face may be seen in.
vec4 covering(vec4 p, vec4 q, vec4 r, int turn) {
    vec2 low = vec2(2.0);
    vec2 high = vec2(-2.0);
    if (p.w > 0.0) include(p.xy / p.w, low, high);
    if (q.w > 0.0) include(q.xy / q.w, low, high);
    if (r.w > 0.0) include(r.xy / r.w, low, high);
    includeCrossing(p, q, low, high);
    includeCrossing(q, r, low, high);
    includeCrossing(r, p, low, high);
    vec2 margin = 2.0 * layer.viewport.zw;
    low = max(low - margin, vec2(-1.0));
    high = min(high + margin, vec2(1.0));
    if (any(greaterThanEqual(low, high))) return kNowhere;
    vec2 size = 2.0 * (high - low);
    return vec4(low + vec2(turn == 1 ? size.x : 0.0, turn == 2 ? size.y : 0.0), 0.5, 1.0);
}

// Too far out of the picture to be exact to a part of a pixel; also where it is behind the eye.
bool isLarge(vec4 corner) {
    return corner.z <= 0.0 || max(abs(corner.x), abs(corner.y)) > 4.0 * corner.w;
}

// Corner `turn` of a triangle over all pixels whose lines may meet the triangle; `eitherSide`: also
// where its corners run clockwise.
vec4 outline(vec4 a, vec4 b, vec4 c, int turn, bool eitherSide) {
    // Cut by the plane of the eye, or so large that its outline would be lost to rounding.
    bool large = isLarge(a) || isLarge(b) || isLarge(c);
    return large ? covering(a, b, c, turn) : enlarged(a, b, c, turn, eitherSide);
}
