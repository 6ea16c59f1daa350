// Turns what all cells of a pixel gave together into what its ray shows.
// Uses: model.
#include "lib/layer.glsl"
#include "shared/mesh_bindings.glsl"

layout(binding = kAccumulatedUnit) uniform sampler2D accumulated;

layout(location = 0) out vec4 colour;

void main() {
    colour = endRay(unpackRay(texelFetch(accumulated, ivec2(gl_FragCoord.xy), 0)), 1.0);
}
