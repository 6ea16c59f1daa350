// Where a line that crosses one face of a cell crosses another one.
#include "mesh/mesh.glsl"

// The other face, as the one that is known with one corner replaced by the apex. `weights`: of its
// corners, >= 0.
struct OtherFace {
    bvec3 replaced;
    vec3 weights;
};

// The line crosses the face (a, b, c), which its areas say is counter-clockwise; q is the apex.
OtherFace otherFace(Corner a, Corner b, Corner c, Corner q, vec3 weights) {
    vec3 areas = vec3(areaOf(q, a), areaOf(q, b), areaOf(q, c));
    bool leftA = isLeft(areas.x, q, a);
    bool leftB = isLeft(areas.y, q, b);
    bool leftC = isLeft(areas.z, q, c);
    bool dropsC = leftA && !leftB;
    bool dropsA = leftB && !leftC;
    bool dropsB = !dropsA && !dropsC;
    return OtherFace(bvec3(dropsA, dropsB, dropsC),
                     max(vec3(dropsA ? weights.x : dropsB ? areas.z : -areas.y,
                              dropsB ? weights.y : dropsC ? areas.x : -areas.z,
                              dropsC ? weights.z : dropsA ? areas.y : -areas.x), 0.0));
}

// What belongs to the other face's corners, of what belongs to the known one's and to the apex.
vec3 onOther(OtherFace other, vec3 face, float apex) {
    return mix(face, vec3(apex), other.replaced);
}
