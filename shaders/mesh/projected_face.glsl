// The face of a cell under a pixel, which is drawn a little too large, and the pixel's line.
// Constants: those of lib/window.glsl and mesh/values.glsl.
#include "lib/window.glsl"
#include "mesh/cell_exit.glsl"
#include "mesh/face_mean.glsl"
#include "mesh/projection_sides.glsl"
#include "mesh/values.glsl"

layout(location = 0) flat in ivec4 faceCorners;  // a, b, c and the apex
layout(location = 1) flat in int faceCell;

struct ProjectedFace {
    Corner a, b, c;
    vec3 areas;
};

ProjectedFace projectedFace(Sight sight) {
    Corner a = cornerOf(faceCorners.x, sight);
    Corner b = cornerOf(faceCorners.y, sight);
    Corner c = cornerOf(faceCorners.z, sight);
    return ProjectedFace(a, b, c, vec3(areaOf(b, c), areaOf(c, a), areaOf(a, b)));
}

// Which edges the line is to the left of: all or none where it crosses the face.
bvec3 leftOf(ProjectedFace face) {
    return bvec3(isLeft(face.areas.x, face.b, face.c), isLeft(face.areas.y, face.c, face.a),
                 isLeft(face.areas.z, face.a, face.b));
}

// The value of a field on a face; at cells it is the same everywhere.
float projectedValue(int valuesAt, vec3 values, vec3 weights) {
    return valuesAt == kValuesAtCells ? values.x : faceMean(values, weights, values.x);
}
