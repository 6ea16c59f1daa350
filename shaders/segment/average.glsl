// One piece of constant value, the mean of both ends; exact where the fields are constant in it.
// Emission is the colour times the extinction, so a piece of opacity a adds a C.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/mean_matter.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 mean = takeMean(rest);
    return vec4(mean.rgb * mean.a, mean.a);
}
