// What a level cuts out of each cell that meets it: a triangle, or a quadrilateral as two; 6 vertices
// a cell, kCellsAnInstance cells an instance. A triangle covers all pixels whose lines may meet it
// (mesh/outline.glsl). Its corners are points on edges of the cell, made from the edge's ends in the
// order of their numbers: all cells around an edge make the same bits.
// Constants: kValuesAt, kDensityAt; kTwoMaps: coloured by g; kLit; kCellsAnInstance.
// Source: A. Doi, A. Koide, An Efficient Method of Triangulating Equi-Valued Surfaces by Using
// Tetrahedral Cells, IEICE Transactions E74(1), 1991.
#include "mesh/corner_values.glsl"
#include "mesh/triangle_outline.glsl"

layout(binding = kCornerUnit) uniform isamplerBuffer cellCorners;
layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;
layout(binding = kLevelUnit) uniform samplerBuffer levelValues;
layout(binding = kLevelCellUnit) uniform isamplerBuffer levelCells;

layout(location = 0) flat out vec4 pointA;   // xyz: camera space, w: g there
layout(location = 1) flat out vec4 pointB;
layout(location = 2) flat out vec4 pointC;
layout(location = 3) flat out ivec4 edgesAB; // the numbers of their edges' ends, ascending
layout(location = 4) flat out ivec3 edgeC;   // z: the level's number
layout(location = 5) flat out vec3 gradient; // of f in the cell, camera space, of any length

struct Cell {
    ivec4 ids;
    vec3 at[4];
    vec4 f, g;
};

Cell cellOf(int number) {
    Cell cell;
    cell.ids = texelFetch(cellCorners, number);
    for (int i = 0; i < 4; ++i) cell.at[i] = texelFetch(cameraVertices, cell.ids[i]).xyz;
    cell.f = cornerValues(fieldValues, kValuesAt, number, cell.ids);
    cell.g = kTwoMaps ? cornerValues(densityValues, kDensityAt, number, cell.ids) : vec4(0.0);
    return cell;
}

// The corners at both ends of three edges that a level cuts, as pairs in x, y and z.
struct Edges {
    ivec3 from, to;
};

int firstOf(bvec4 set) {
    return set.x ? 0 : set.y ? 1 : set.z ? 2 : 3;
}

int lastOf(bvec4 set) {
    return set.w ? 3 : set.z ? 2 : set.y ? 1 : 0;
}

// The edges between the corners in `below` and the others: all three of one corner, or three of the
// four of two: triangle `part` of the quadrilateral. Nothing of a second part: `from` is -1.
Edges edgesBetween(bvec4 below, int part) {
    int count = int(below.x) + int(below.y) + int(below.z) + int(below.w);
    if (count == 2) {
        int p = firstOf(below);
        int q = lastOf(below);
        int r = firstOf(not(below));
        int s = lastOf(not(below));
        return part == 0 ? Edges(ivec3(p, p, q), ivec3(r, s, s))
                         : Edges(ivec3(p, q, q), ivec3(r, s, r));
    }
    if (part == 1) return Edges(ivec3(-1), ivec3(-1));
    int single = count == 1 ? firstOf(below) : firstOf(not(below));
    return Edges(ivec3(single),
                 ivec3(single == 0 ? 1 : 0, single <= 1 ? 2 : 1, single <= 2 ? 3 : 2));
}

vec4 pointOn(Cell cell, int from, int to, float level, out ivec2 edge) {
    bool ascends = cell.ids[from] < cell.ids[to];
    int p = ascends ? from : to;
    int q = ascends ? to : from;
    edge = ivec2(cell.ids[p], cell.ids[q]);
    precise float share = clamp((level - cell.f[p]) / (cell.f[q] - cell.f[p]), 0.0, 1.0);
    precise vec4 point = mix(vec4(cell.at[p], cell.g[p]), vec4(cell.at[q], cell.g[q]), share);
    return point;
}

vec3 gradientIn(Cell cell) {
    vec3 found = gradientAlong(cell.at[0] - cell.at[3], cell.at[1] - cell.at[3],
                               cell.at[2] - cell.at[3], cell.f.xyz - cell.f.w);
    return found / max(max(abs(found.x), abs(found.y)), max(abs(found.z), 1.0e-37));
}

void main() {
    int place = gl_VertexID / 6 + kCellsAnInstance * gl_InstanceID;
    int part = gl_VertexID % 6 / 3;
    int turn = gl_VertexID % 3;
    pointA = vec4(0.0);
    pointB = vec4(0.0);
    pointC = vec4(0.0);
    edgesAB = ivec4(0);
    edgeC = ivec3(0);
    gradient = vec3(0.0);
    gl_Position = kNowhere;
    if (place >= textureSize(levelCells)) return;  // The last instance has room for more.
    ivec2 listed = texelFetch(levelCells, place).xy;
    float level = texelFetch(levelValues, listed.y).r;
    Cell cell = cellOf(listed.x);
    Edges edges = edgesBetween(lessThan(cell.f, vec4(level)), part);
    if (edges.from.x < 0) return;
    ivec2 a, b, c;
    pointA = pointOn(cell, edges.from.x, edges.to.x, level, a);
    pointB = pointOn(cell, edges.from.y, edges.to.y, level, b);
    pointC = pointOn(cell, edges.from.z, edges.to.z, level, c);
    edgesAB = ivec4(a, b);
    edgeC = ivec3(c, listed.y);
    if (kLit) gradient = gradientIn(cell);
    gl_Position = outline(clipOf(pointA.xyz), clipOf(pointB.xyz), clipOf(pointC.xyz), turn, true);
}
