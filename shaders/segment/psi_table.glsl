// As segment/psi.glsl, with the weights from a table over both depths: partial pre-integration.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, IEEE
// VolVis 2004; the table holds the share of the back end instead of Psi.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/psi_table.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 front = cursor.matter;
    vec4 back = matterAt(rest.back, rest.densityBack);
    vec2 share = psiFromTable(front.a * rest.extent, back.a * rest.extent);
    takeAll(cursor, rest, back);
    return vec4(mix(front.rgb, back.rgb, share.x) * share.y, share.y);
}
