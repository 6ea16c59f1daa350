// A mesh as its passes read it. Boundary face f: texel 2 f holds its cell and its vertices a, b, c,
// counter-clockwise seen from outside; texel 2 f + 1 the boundary faces across ab, bc, ca (-1: none)
// and the cell's fourth vertex. Constants: kDensityAt: where a second field has its values.
#include "shared/bindings.glsl"
#include "shared/mesh_bindings.glsl"
#include "shared/mesh_block.glsl"

layout(std140, binding = kMeshBinding) uniform MeshUniforms {
    MeshBlock meshView;
};

layout(binding = kVertexUnit) uniform samplerBuffer cameraVertices;
layout(binding = kBoundaryUnit) uniform isamplerBuffer boundaryRecords;
layout(binding = kDensityUnit) uniform samplerBuffer densityValues;

// The line of one pixel, in camera space: xy = offset + z slope.
struct Sight {
    vec2 offset;
    vec2 slope;
};

// `at`: position in the picture, each coordinate in [-1, 1].
Sight sightThrough(vec2 at) {
    return Sight(at * meshView.rayOffset.xy, at * meshView.raySlope.xy);
}

// A vertex as one line sees it: `at` is its place beside the line (sheared along it, so the line
// meets what holds the origin), `depth` its z.
struct Corner {
    vec2 at;
    float depth;
    float value;
    float density;  // of the second field, where that has values at vertices
    int id;
};

Corner cornerOf(int id, Sight sight) {
    vec4 vertex = texelFetch(cameraVertices, id);
    // The same bits for a vertex whichever cell asks: neighbours must agree on every sign.
    precise vec2 at = (vertex.xy - sight.offset) - vertex.z * sight.slope;
    float density = 0.0;
    if (kDensityAt == kValuesAtVertices) density = texelFetch(densityValues, id).r;
    return Corner(at, vertex.z, vertex.w, density, id);
}

// Twice the signed area of (origin, p, q); > 0 where q is counter-clockwise of p. Without fused
// operations it changes exactly its sign when p and q change places.
float areaOf(Corner p, Corner q) {
    precise float area = p.at.x * q.at.y - p.at.y * q.at.x;
    return area;
}

// Sign of areaOf(p, q) = `area`, never 0: a line through an edge or a vertex is moved by (e, e^2),
// e infinitely small, and what then still ties is decided by the vertices' numbers. One line thus
// meets exactly one of the cells around an edge or vertex at a time.
bool isLeft(float area, Corner p, Corner q) {
    float moved = p.at.y == q.at.y ? q.at.x - p.at.x : p.at.y - q.at.y;
    float side = area == 0.0 ? moved : area;
    return side > 0.0 || (side == 0.0 && p.id < q.id);
}
