// Boundary faces as triangles in the picture, to find where lines enter. Faces seen from behind are
// left out here; the fragment shader finds out exactly which face a line enters.
#include "mesh/outline.glsl"

void main() {
    int face = gl_VertexID / 3;
    int turn = gl_VertexID - 3 * face;
    ivec3 ids = texelFetch(boundaryRecords, 2 * face).yzw;
    vec4 a = clipOf(ids.x);
    vec4 b = clipOf(ids.y);
    vec4 c = clipOf(ids.z);
    // Where the plane of the eye cuts a face it has no outline in pixels; it stays as it is.
    bool before = min(a.z, min(b.z, c.z)) > 0.0;
    gl_Position = before ? enlarged(a, b, c, turn, false) : turn == 0 ? a : turn == 1 ? b : c;
}
