// Vertices into camera space, once a camera move. In double: the position relative to the eye is a
// small difference of large numbers where the eye is close to a large mesh.
// Constants: kValuesAt.
#include "shared/bindings.glsl"
#include "shared/mesh_bindings.glsl"
#include "shared/mesh_block.glsl"

layout(local_size_x = 128) in;

layout(std140, binding = kMeshBinding) uniform MeshUniforms {
    MeshBlock meshView;
};
layout(binding = kPositionUnit) uniform samplerBuffer positions;
layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;
layout(std430, binding = kVertexStorage) writeonly buffer CameraVertices {
    vec4 vertices[];
};

double along(dvec4 axis, dvec3 position) {
    return dot(axis.xyz, position) + axis.w;
}

void main() {
    int id = int(gl_GlobalInvocationID.x +
                 gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x);
    if (id >= meshView.start.y) return;
    dvec3 position = dvec3(texelFetch(positions, 3 * id).r, texelFetch(positions, 3 * id + 1).r,
                           texelFetch(positions, 3 * id + 2).r);
    float value = 0.0;
    if (kValuesAt == kValuesAtVertices) value = texelFetch(fieldValues, id).r;
    vertices[id] = vec4(float(along(meshView.right, position)), float(along(meshView.up, position)),
                        float(along(meshView.forward, position)), value);
}
