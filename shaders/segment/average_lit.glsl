// As segment/average.glsl, under a light.
// Uses: classify.
#include "lib/light.glsl"
#include "lib/map_cursor.glsl"
#include "lib/mean_matter.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 mean = takeMean(rest);
    return vec4((mean.rgb * pieceLight.x + pieceLight.y) * mean.a, mean.a);
}
