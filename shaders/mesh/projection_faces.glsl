// The values where rays cross faces, for models that ask for extremes of both ends of pieces: the
// faces are all ends there are. Needs rays that nothing cuts within a cell.
// Uses: model.
#include "mesh/projected_face.glsl"

layout(location = 0) out vec4 share;

void main() {
    if (gl_HelperInvocation) return;
    Sight sight = sightThrough(pictureFrom(gl_FragCoord.xy));
    ProjectedFace face = projectedFace(sight);
    bvec3 left = leftOf(face);
    if (any(left) && !all(left)) discard;
    vec3 weights = abs(face.areas);
    vec3 depths = vec3(face.a.depth, face.b.depth, face.c.depth);
    float depth = faceMean(depths, weights, min(depths.x, min(depths.y, depths.z)));
    vec3 values = valuesIn(faceCell, face.a, face.b, face.c, cornerOf(faceCorners.w, sight)).front;
    float value = projectedValue(kValuesAt, values, weights);
    Segment point = Segment(value, value, 0.0, 0.0, 0.0, depth * worldPerDepth(sight));
    RayState state = beginRay(rayThrough(gl_FragCoord.xy));
    enterData(state, point);
    stepRay(state, point);
    share = packRay(state);
}
