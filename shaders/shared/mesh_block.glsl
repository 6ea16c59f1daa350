// How a view sees a mesh; read by C++ (after `using glm::dvec4;` and so on) and by GLSL as an std140
// block. It is all that a camera move uploads.
//
// "Camera space" here: x right, y up, z (depth) away from the plane where rays start, in units of
// half the mesh's diagonal, so that no product overflows whatever unit the mesh is in. With
// u, v in [-1, 1] across the picture, a ray is the line  xy = (u, v) rayOffset + z (u, v) raySlope.
struct MeshBlock {
    dvec4 right;       // camera x = dot(right.xyz, data position) + right.w
    dvec4 up;
    dvec4 forward;
    vec4 raySlope;     // xy: 0 in an orthographic camera; z: world units a unit of depth
    vec4 rayOffset;    // xy
    vec4 raster;       // xy: clip xy = raster.xy * camera xy; clip w = raster.z * z + raster.w
    ivec4 startVertices;  // of the cell the eye is in, positively oriented
    ivec4 start;       // x: the cell the eye is in, or -1; y: number of vertices
};
