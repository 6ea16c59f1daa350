// Extinction grows evenly from one end to the other, and colours count as they would if the piece
// were thin: exact to first order in its depth.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, IEEE
// VolVis 2004, section 4.
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
