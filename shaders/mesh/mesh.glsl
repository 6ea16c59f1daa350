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

// World units along a line for each unit of depth.
float worldPerDepth(Sight sight) {
    return meshView.raySlope.z * sqrt(1.0 + dot(sight.slope, sight.slope));
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

// Where a point in camera space is beside a line: the same bits whichever cell asks, for neighbours
// must agree on every sign.
vec2 beside(vec3 point, Sight sight) {
    precise vec2 at = (point.xy - sight.offset) - point.z * sight.slope;
    return at;
}

Corner cornerOf(int id, Sight sight) {
    vec4 vertex = texelFetch(cameraVertices, id);
    float density = 0.0;
    if (kDensityAt == kValuesAtVertices) density = texelFetch(densityValues, id).r;
    return Corner(beside(vertex.xyz, sight), vertex.z, vertex.w, density, id);
}

// Twice the signed area of (origin, p, q); > 0 where q is counter-clockwise of p. Without fused
// operations it changes exactly its sign when p and q change places.
float areaOf(vec2 p, vec2 q) {
    precise float area = p.x * q.y - p.y * q.x;
    return area;
}

float areaOf(Corner p, Corner q) {
    return areaOf(p.at, q.at);
}

// Sign of areaOf(p, q) = `area`, never 0: a line through an edge or a vertex is moved by (e, e^2),
// e infinitely small, and what then still ties is decided by the vertices' numbers. One line thus
// meets exactly one of the cells around an edge or vertex at a time. `first`: p's number is the lower.
bool isLeft(float area, vec2 p, vec2 q, bool first) {
    float moved = p.y == q.y ? q.x - p.x : p.y - q.y;
    float side = area == 0.0 ? moved : area;
    return side > 0.0 || (side == 0.0 && first);
}

bool isLeft(float area, Corner p, Corner q) {
    return isLeft(area, p.at, q.at, p.id < q.id);
}
