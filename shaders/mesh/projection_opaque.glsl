// Where rays are ended by something opaque in one cell; of all cells the nearest shows.
// Uses: model.
#include "lib/depth.glsl"
#include "mesh/projected_cell.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

void main() {
    if (gl_HelperInvocation) return;
    RayState state;
    float facing;
    if (!gatherCell(state, facing)) discard;
    distanceOut = hitDistance(state);
    if (distanceOut >= kNoHit) discard;
    colour = endRay(state, facing);
    gl_FragDepth = depthAt(rayThrough(gl_FragCoord.xy), distanceOut);
}
