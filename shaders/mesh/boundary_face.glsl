// Boundary faces in data space, and the values at their corners. Constants: kValuesAt.
#include "shared/bindings.glsl"
#include "shared/mesh_bindings.glsl"

layout(binding = kPositionUnit) uniform samplerBuffer positions;
layout(binding = kBoundaryUnit) uniform isamplerBuffer boundaryRecords;
layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;

struct BoundaryFace {
    int cell;
    ivec3 vertices;
    int apex;  // the cell's fourth vertex
};

BoundaryFace boundaryFace(int face) {
    ivec4 record = texelFetch(boundaryRecords, 2 * face);
    return BoundaryFace(record.x, record.yzw, texelFetch(boundaryRecords, 2 * face + 1).w);
}

vec3 positionOf(int id) {
    return vec3(texelFetch(positions, 3 * id).r, texelFetch(positions, 3 * id + 1).r,
                texelFetch(positions, 3 * id + 2).r);
}

// Value at vertex `id` of the face, as its cell sees it.
float faceValue(BoundaryFace face, int id) {
    if (kValuesAt == kValuesAtVertices) return texelFetch(fieldValues, id).r;
    vec4 stored = texelFetch(fieldValues, face.cell);
    if (kValuesAt == kValuesAtCells) return stored.r;
    int rank = int(face.vertices.x < id) + int(face.vertices.y < id) + int(face.vertices.z < id) +
               int(face.apex < id);
    return stored[rank];
}
