// As segment/average.glsl, under a light.
// Uses: classify.
#include "lib/map_cursor.glsl"
#include "lib/opacity.glsl"
#include "lib/light.glsl"

vec4 integrateSegment(inout MapCursor cursor, inout Segment rest) {
    vec4 matter = matterAt(0.5 * (rest.front + rest.back),
                           0.5 * (rest.densityFront + rest.densityBack));
    float opacity = opacityOf(matter.a * rest.extent);
    rest.extent = -1.0;
    return vec4((matter.rgb * pieceLight.x + pieceLight.y) * opacity, opacity);
}
