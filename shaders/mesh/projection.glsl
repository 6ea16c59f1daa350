// One cell's share of the rays that cross it, blended with those of the others. For models whose
// packed states combine by a blend equation; lib/finish_shares.glsl turns the sum into a
// picture.
// Uses: model.
#include "mesh/projected_cell.glsl"

layout(location = 0) out vec4 share;

void main() {
    if (gl_HelperInvocation) return;
    RayState state;
    if (!gatherCell(state)) discard;
    share = packRay(state);
}
