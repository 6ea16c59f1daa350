// Boundary faces as triangles. Constants: kValuesAt, kReadsValues.
#include "lib/layer.glsl"
#include "mesh/boundary_face.glsl"

layout(location = 0) out float vertexValue;

void main() {
    BoundaryFace face = boundaryFace(gl_VertexID / 3);
    int corner = gl_VertexID % 3;
    int id = corner == 0 ? face.vertices.x : corner == 1 ? face.vertices.y : face.vertices.z;
    gl_Position = layer.clipFromData * vec4(positionOf(id), 1.0);
    vertexValue = kReadsValues ? faceValue(face, id) : 0.0;
}
