// A field's values in a cell. Constants: kValuesAt.
#include "mesh/walk_state.glsl"

layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;

struct CellValues {
    vec3 front;  // at the corners of the face the walk came in through
    float apex;
};

float pick(vec4 list, int rank) {
    vec2 pair = rank < 2 ? list.xy : list.zw;
    return (rank & 1) == 0 ? pair.x : pair.y;
}

// Values at the corners of `walk.cell`, of which `q` is the apex. Stored corner values are ordered
// by vertex number.
CellValues valuesIn(Walk walk, Corner q) {
    if (kValuesAt == kValuesAtVertices) {
        return CellValues(vec3(walk.a.value, walk.b.value, walk.c.value), q.value);
    }
    if (kValuesAt == kValuesAtCells) {
        float value = texelFetch(fieldValues, walk.cell).r;
        return CellValues(vec3(value), value);
    }
    vec4 stored = texelFetch(fieldValues, walk.cell);
    ivec4 ids = ivec4(walk.a.id, walk.b.id, walk.c.id, q.id);
    ivec4 ranks = ivec4(lessThan(ids.xxxx, ids)) + ivec4(lessThan(ids.yyyy, ids)) +
                  ivec4(lessThan(ids.zzzz, ids)) + ivec4(lessThan(ids.wwww, ids));
    return CellValues(vec3(pick(stored, ranks.x), pick(stored, ranks.y), pick(stored, ranks.z)),
                      pick(stored, ranks.w));
}

// The value on a face; `known` where the face is seen edge-on and has no weights.
float valueOn(vec3 values, vec3 weights, float known) {
    return kValuesAt == kValuesAtCells ? values.x : meanOf(values, weights, known);
}
