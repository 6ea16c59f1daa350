// Rays that march through a voxel volume, blended over what is there.
// Uses: model.
#include "volume/march_ray.glsl"

layout(location = 0) out vec4 colour;

void main() {
    float distance;
    colour = castRay(gl_FragCoord.xy, distance);
}
