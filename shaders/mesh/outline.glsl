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
// Corners are drawn out by so many margins at most, and faces thinner than kThin of their length
// are drawn as boxes: their corners may be so sharp that this would not move their edges.
const float kLongestTip = 32.0;
const float kThin = 1.0 / 64.0;

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

// Corner `turn` of a triangle over a box of which `base` is one side: from base to base + along and
// `height` to its left, and kMargin more all round. Pixels.
vec2 boxCorner(vec2 base, vec2 along, float height, int turn) {
    float size = length(along);
    vec2 right = size > 0.0 ? along / size : vec2(1.0, 0.0);
    vec2 up = vec2(-right.y, right.x);
    vec2 corner = base - kMargin * (right + up);
    return turn == 0   ? corner
           : turn == 1 ? corner + 2.0 * (size + 2.0 * kMargin) * right
                       : corner + 2.0 * (height + 2.0 * kMargin) * up;
}

// Corner `turn` of the larger triangle of a face that lies before the eye (all clip.z > 0).
// `eitherSide`: also where its corners run clockwise; otherwise such a face is not drawn.
vec4 enlarged(vec4 clipA, vec4 clipB, vec4 clipC, int turn, bool eitherSide) {
    vec2 pixels = 0.5 * layer.viewport.xy;
    vec2 a = clipA.xy / clipA.w * pixels;
    vec2 b = clipB.xy / clipB.w * pixels;
    vec2 c = clipC.xy / clipC.w * pixels;
    float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (eitherSide && area < 0.0) {
        vec2 other = b;
        b = c;
        c = other;
        area = -area;
    }
    vec3 sides = vec3(length(b - a), length(c - b), length(a - c));
    float longest = max(sides.x, max(sides.y, sides.z));
    float width = longest > 0.0 ? area / longest : 0.0;
    if (width < -kMargin) return kNowhere;
    vec2 corner;
    if (width > kThin * longest) {
        corner = turn == 0   ? outwards(c, a, b)
                 : turn == 1 ? outwards(a, b, c)
                             : outwards(b, c, a);
    } else if (sides.x == longest) {
        corner = boxCorner(a, b - a, max(width, 0.0), turn);
    } else if (sides.y == longest) {
        corner = boxCorner(b, c - b, max(width, 0.0), turn);
    } else {
        corner = boxCorner(c, a - c, max(width, 0.0), turn);
    }
    return vec4(corner / pixels, 0.5, 1.0);
}
