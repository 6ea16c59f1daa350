// One piece of constant value, the mean of both ends; exact where the fields are constant in it.
// Emission is the colour times the extinction, so a piece of opacity a adds a C.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/opacity.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 matter = matterAt(0.5 * (rest.front + rest.back),
                           0.5 * (rest.densityFront + rest.densityBack));
    float opacity = opacityOf(matter.a * rest.extent);
    rest.extent = -1.0;
    return vec4(matter.rgb * opacity, opacity);
}
