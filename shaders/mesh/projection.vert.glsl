// Cells by their faces: 12 vertices a cell, kCellsAnInstance cells an instance. Each face covers the
// pixels whose lines may meet it (mesh/outline.glsl); its corners go to the fragment shader in an
// order that is counter-clockwise in the picture where only one side of faces is drawn.
// Constants: kSorted: cells come as cellOrder has them; kSides: which faces are drawn;
// kCellsAnInstance.
#include "mesh/triangle_outline.glsl"
#include "mesh/projection_sides.glsl"

layout(binding = kCornerUnit) uniform isamplerBuffer cellCorners;
layout(binding = kOrderUnit) uniform isamplerBuffer cellOrder;

layout(location = 0) flat out ivec4 faceCorners;  // a, b, c and the apex
layout(location = 1) flat out int faceCell;

// The corners of face i of a positively oriented cell, counter-clockwise from outside, and the one
// opposite to it.
ivec4 faceOf(ivec4 cell, int i) {
    return i == 0 ? cell.yzwx : i == 1 ? cell.xwzy : i == 2 ? cell.xywz : cell.xzyw;
}

void main() {
    int place = gl_VertexID / 12;
    int face = (gl_VertexID - 12 * place) / 3;
    int turn = gl_VertexID - 12 * place - 3 * face;
    place += kCellsAnInstance * gl_InstanceID;
    if (place >= textureSize(cellCorners)) {  // The last instance has room for more.
        faceCell = 0;
        faceCorners = ivec4(0);
        gl_Position = kNowhere;
        return;
    }
    faceCell = kSorted ? texelFetch(cellOrder, place).r : place;
    faceCorners = faceOf(texelFetch(cellCorners, faceCell), face);
    // From the eye, faces on the far side run the other way round.
    if (kSides == kFarSides) faceCorners = faceCorners.xzyw;
    vec4 a = clipOf(faceCorners.x);
    vec4 b = clipOf(faceCorners.y);
    vec4 c = clipOf(faceCorners.z);
    gl_Position = outline(a, b, c, turn, kSides == kAllSides);
}
