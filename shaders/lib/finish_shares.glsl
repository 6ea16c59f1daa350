// Turns what all cells or slices of a pixel gave together into what its ray shows.
// Uses: model.
#include "lib/layer.glsl"

layout(binding = kShareUnit) uniform sampler2D shares;

layout(location = 0) out vec4 colour;

void main() {
    colour = endRay(unpackRay(texelFetch(shares, ivec2(gl_FragCoord.xy), 0)), 1.0);
}
