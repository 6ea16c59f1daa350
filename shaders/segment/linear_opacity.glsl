// Colour and opacity linear between what the map gives at both ends, by an approximation without
// erfc or Dawson: opacity exact where the map is linear between the ends, colour where extinction
// is also the same at both.
// Source: K. Moreland, Fast High Accuracy Volume Rendering, PhD thesis, University of New Mexico,
// 2004, section 1.3.2.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/linear_opacity.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 front = cursor.matter;
    vec4 back = matterAt(rest.back, rest.densityBack);
    vec2 share = linearOpacity(front.a * rest.extent, back.a * rest.extent);
    takeAll(cursor, rest, back);
    return vec4(mix(front.rgb, back.rgb, share.x) * share.y, share.y);
}
