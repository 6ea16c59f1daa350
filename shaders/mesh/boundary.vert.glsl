// Boundary faces as triangles in the picture, to find where lines enter.
#include "mesh/mesh.glsl"

// Faces closer to the eye than this are not found; in units of half the mesh's diagonal.
const float kNearest = 1.0e-7;

void main() {
    int face = gl_VertexID / 3;
    ivec4 record = texelFetch(boundaryRecords, 2 * face);
    int corner = gl_VertexID - 3 * face;
    int id = corner == 0 ? record.y : corner == 1 ? record.z : record.w;
    vec3 at = texelFetch(cameraVertices, id).xyz;
    float w = meshView.raster.z * at.z + meshView.raster.w;
    // Depth only cuts off what is behind the eye; nothing is clipped in an orthographic camera.
    gl_Position = vec4(meshView.raster.xy * at.xy, w - kNearest * meshView.raster.z, w);
}
