// The piece of a pixel's line in a cell that is drawn by one of its faces: the near one, or where
// rays may start within the mesh the far one, which is before the eye in whatever cell that is in.
// Constants: kSides; those of mesh/trim.glsl and mesh/projected_face.glsl.
// Uses: model.
#include "mesh/projected_face.glsl"
#include "mesh/trim.glsl"

// At most so many parts of one piece: integrators cut where the map bends, and where it is dense
// until the ray is opaque.
const int kMaxParts = 32768;

Segment pieceOf(ProjectedFace face, Corner q, Sight sight) {
    OtherFace other = otherFace(face.a, face.b, face.c, q, face.areas);
    CellValues values = valuesIn(faceCell, face.a, face.b, face.c, q);
    CellValues densities = densitiesIn(faceCell, face.a, face.b, face.c, q);
    vec3 depths = vec3(face.a.depth, face.b.depth, face.c.depth);
    float known = min(depths.x, min(depths.y, depths.z));
    float here = faceMean(depths, face.areas, known);
    float there = faceMean(onOther(other, depths, q.depth), other.weights, here);
    float value = projectedValue(kValuesAt, values.front, face.areas);
    float density = projectedValue(kDensityAt, densities.front, face.areas);
    vec3 ends = onOther(other, values.front, values.apex);
    vec3 densityEnds = onOther(other, densities.front, densities.apex);
    float otherValue = projectedValue(kValuesAt, ends, other.weights);
    float otherDensity = projectedValue(kDensityAt, densityEnds, other.weights);
    if (kDensityAt == kValuesNowhere) {
        density = value;
        otherDensity = otherValue;
    }
    float world = worldPerDepth(sight);
    if (kSides == kFarSides) {
        return Segment(otherValue, value, otherDensity, density, max(here - there, 0.0) * world,
                       min(there, here) * world);
    }
    return Segment(value, otherValue, density, otherDensity, max(there - here, 0.0) * world,
                   here * world);
}

// What the pixel's ray gathers in the cell. False: nothing, as where it does not cross it.
bool gatherCell(out RayState state) {
    Ray ray = rayThrough(gl_FragCoord.xy);
    state = beginRay(ray);
    Sight sight = sightThrough(pictureFrom(gl_FragCoord.xy));
    ProjectedFace face = projectedFace(sight);
    if (!all(leftOf(face))) return false;
    Corner q = cornerOf(faceCorners.w, sight);
    Segment rest = trimmed(pieceOf(face, q, sight), windowOf(ray, gl_FragCoord.xy));
    if (rest.extent < 0.0) return false;
    enterData(state, rest);
    for (int part = 0; part < kMaxParts && rest.extent >= 0.0; ++part) {
        if (stepRay(state, rest)) break;
    }
    return true;
}
