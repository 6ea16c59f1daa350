// The face where each pixel's line enters a convex mesh: there is at most one.
#include "lib/layer.glsl"
#include "mesh/entry.glsl"

layout(location = 0) out int face;

void main() {
    if (gl_HelperInvocation) return;
    Entry entry = repairedEntry(gl_PrimitiveID, sightThrough(pictureFrom(gl_FragCoord.xy)));
    if (entry.face < 0) discard;
    face = entry.face;
}
