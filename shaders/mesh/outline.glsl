// Faces as triangles in the picture, to find the lines that meet them.
//
// The rasteriser snaps vertices to a grid of 1/256 pixel and would miss lines right beside an edge,
// and with them all that lies behind. So triangles are drawn larger by kMargin all round; the
// fragment shader finds out exactly which lines meet which face.
#include "lib/layer.glsl"
#include "mesh/mesh.glsl"

// Faces closer to the eye than this have no outline; in units of half the mesh's diagonal.
const float kNearest = 1.0e-7;

const float kMargin = 1.0 / 64.0;  // pixels
const float kLongestTip = 8.0;     // margins; sharper corners are not drawn out further

// A triangle with this as each of its corners is a point and covers nothing. It is within the
// picture: what is outside has to be clipped, which costs more.
const vec4 kNowhere = vec4(0.0, 0.0, 0.5, 1.0);

// Depth only cuts off what is behind the eye; nothing is clipped in an orthographic camera.
vec4 clipOf(vec3 at) {
    float w = meshView.raster.z * at.z + meshView.raster.w;
    return vec4(meshView.raster.xy * at.xy, w - kNearest * meshView.raster.z, w);
}

vec4 clipOf(int id) {
    return clipOf(texelFetch(cameraVertices, id).xyz);
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

// A corner of a face that lies before the eye (all clip.z > 0), and the two that come next, as the
// clip position of the same corner of the larger triangle. `eitherSide`: also where they run
// clockwise; otherwise such a face is not drawn.
vec4 enlarged(vec4 clip, vec4 next, vec4 last, bool eitherSide) {
    vec2 pixels = 0.5 * layer.viewport.xy;
    vec2 a = clip.xy / clip.w * pixels;
    vec2 b = next.xy / next.w * pixels;
    vec2 c = last.xy / last.w * pixels;
    vec2 ab = b - a;
    vec2 ac = c - a;
    float width = (ab.x * ac.y - ab.y * ac.x) / max(max(length(ab), length(ac)), length(c - b));
    if (width < -kMargin && !eitherSide) return kNowhere;
    bool turned = width < 0.0 && eitherSide;
    vec2 corner = turned ? outwards(b, a, c) : outwards(c, a, b);
    return vec4(corner / pixels * clip.w, clip.zw);
}
