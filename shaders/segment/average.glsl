// One piece of constant value, the mean of both ends; exact where the field is constant in it.
// Emission is the colour times the extinction, so a piece of opacity a adds a C.
// Uses: classify.
#include "lib/opacity.glsl"

vec4 integrateSegment(Segment piece) {
    vec4 matter = classify(0.5 * (piece.front + piece.back));
    float opacity = opacityOf(matter.a * piece.extent);
    return vec4(matter.rgb * opacity, opacity);
}
