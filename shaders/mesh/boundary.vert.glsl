// Boundary faces as triangles in the picture, to find where lines enter. Faces seen from behind are
// left out here; the fragment shader finds out exactly which face a line enters.
#include "mesh/outline.glsl"

void main() {
    int face = gl_VertexID / 3;
    int turn = gl_VertexID - 3 * face;
    ivec3 ids = texelFetch(boundaryRecords, 2 * face).yzw;
    ids = turn == 0 ? ids : turn == 1 ? ids.yzx : ids.zxy;
    vec4 clip = clipOf(ids.x);
    vec4 next = clipOf(ids.y);
    vec4 last = clipOf(ids.z);
    // Where the plane of the eye cuts a face it has no outline in pixels; it stays as it is.
    bool before = min(clip.z, min(next.z, last.z)) > 0.0;
    gl_Position = before ? enlarged(clip, next, last, false) : clip;
}
