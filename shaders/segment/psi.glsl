// Extinction and colour linear between what the map gives at both ends, integrated in closed form.
// Exact where the map is linear between the ends.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, IEEE
// VolVis 2004.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/psi.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 front = cursor.matter;
    vec4 back = matterAt(rest.back, rest.densityBack);
    vec3 weights = psiWeights(front.a * rest.extent, back.a * rest.extent);
    takeAll(cursor, rest, back);
    return vec4(weights.x * front.rgb + weights.y * back.rgb, weights.z);
}
