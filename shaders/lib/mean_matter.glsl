// A piece as if it were constant, of the mean of both its ends' values.
// Uses: classify.
#include "lib/opacity.glsl"

// Takes all of `rest`; rgb: its colour, a: its opacity.
vec4 takeMean(inout Segment rest) {
    vec4 matter = matterAt(0.5 * (rest.front + rest.back),
                           0.5 * (rest.densityFront + rest.densityBack));
    float opacity = opacityOf(matter.a * rest.extent);
    rest.extent = -1.0;
    return vec4(matter.rgb, opacity);
}
