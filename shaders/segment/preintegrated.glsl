// Mean extinction and extinction-weighted mean colour over [front, back], from a table over both
// ends; within the piece both count as constant. Exact in opacity but for the table's resolution.
// Source: K. Engel, M. Kraus, T. Ertl, High-Quality Pre-Integrated Volume Rendering, Graphics
// Hardware 2001; the table here holds no length, opacity follows from the mean.
// Constants: kPreintegratedSide: entries along each axis.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/opacity.glsl"

vec4 preintegratedAt(int texel) {
    return texelFetch(mapTexels, texel);
}

vec4 meanBetween(float front, float back) {
    float scale = float(kPreintegratedSide - 1) / max(mapExtras.z - mapExtras.y, 1.0e-37);
    vec2 at = clamp((vec2(front, back) - mapExtras.y) * scale, 0.0, float(kPreintegratedSide - 1));
    ivec2 low = min(ivec2(at), kPreintegratedSide - 2);
    vec2 t = at - vec2(low);
    int texel = int(mapSections.w) + low.y * kPreintegratedSide + low.x;
    int above = texel + kPreintegratedSide;
    return mix(mix(preintegratedAt(texel), preintegratedAt(texel + 1), t.x),
               mix(preintegratedAt(above), preintegratedAt(above + 1), t.x), t.y);
}

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 mean = meanBetween(rest.front, rest.back);
    // The table weights colours by extinction; where there is none its colour is 0.
    float opacity = opacityOf(mean.a * rest.extent);
    rest.extent = -1.0;
    return vec4(mean.rgb * opacity, opacity);
}
