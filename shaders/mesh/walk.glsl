// Rays that walk from cell to cell, blended over what is there.
// Uses: model.
#include "mesh/walk_ray.glsl"

layout(location = 0) out vec4 colour;

void main() {
    if (gl_HelperInvocation) return;
    float distance;
    castRay(colour, distance);
}
