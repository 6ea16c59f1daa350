// Boundary faces as triangles in the picture, to find where lines enter.
//
// The rasteriser snaps vertices to a grid of 1/256 pixel and would miss lines right beside an edge,
// and with them all that lies behind a hollow. So triangles are drawn larger by kMargin all round;
// the fragment shader finds out exactly which face a line enters. Faces seen from behind are left
// out here, by the same margin.
#include "lib/layer.glsl"
#include "mesh/mesh.glsl"

// Faces closer to the eye than this are not found; in units of half the mesh's diagonal.
const float kNearest = 1.0e-7;

const float kMargin = 1.0 / 64.0;  // pixels
const float kLongestTip = 8.0;     // margins; sharper corners are not drawn out further

vec4 clipOf(int id) {
    vec3 at = texelFetch(cameraVertices, id).xyz;
    float w = meshView.raster.z * at.z + meshView.raster.w;
    // Depth only cuts off what is behind the eye; nothing is clipped in an orthographic camera.
    return vec4(meshView.raster.xy * at.xy, w - kNearest * meshView.raster.z, w);
}

vec2 unit(vec2 v) {
    float size = length(v);
    return size > 0.0 ? v / size : vec2(0.0);
}

// Where `corner` moves when both its edges move outwards by kMargin; counter-clockwise, pixels.
vec2 outwards(vec2 before, vec2 corner, vec2 after) {
    vec2 incoming = unit(corner - before);
    vec2 outgoing = unit(after - corner);
    vec2 normals = vec2(incoming.y, -incoming.x) + vec2(outgoing.y, -outgoing.x);
    // Both parts point along the bisector; one of them is long whatever the angle.
    vec2 bisector = unit(normals + incoming - outgoing);
    float reach = 2.0 / max(length(normals), 2.0 / kLongestTip);
    return corner + bisector * (kMargin * reach);
}

void main() {
    int face = gl_VertexID / 3;
    int turn = gl_VertexID - 3 * face;
    ivec3 ids = texelFetch(boundaryRecords, 2 * face).yzw;
    ids = turn == 0 ? ids : turn == 1 ? ids.yzx : ids.zxy;
    vec4 clip = clipOf(ids.x);
    vec4 next = clipOf(ids.y);
    vec4 last = clipOf(ids.z);
    gl_Position = clip;
    // Where the plane of the eye cuts a face it has no outline in pixels; it stays as it is.
    if (min(clip.z, min(next.z, last.z)) <= 0.0) return;
    vec2 pixels = 0.5 * layer.viewport.xy;
    vec2 a = clip.xy / clip.w * pixels;
    vec2 b = next.xy / next.w * pixels;
    vec2 c = last.xy / last.w * pixels;
    vec2 ab = b - a;
    vec2 ac = c - a;
    float width = (ab.x * ac.y - ab.y * ac.x) / max(max(length(ab), length(ac)), length(c - b));
    if (width < -kMargin) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // Outside the picture, like the two other corners.
        return;
    }
    gl_Position = vec4(outwards(c, a, b) / pixels * clip.w, clip.zw);
}
