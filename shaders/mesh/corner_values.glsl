// Values of fields at the corners of cells.
#include "shared/mesh_bindings.glsl"

float pick(vec4 list, int rank) {
    vec2 pair = rank < 2 ? list.xy : list.zw;
    return (rank & 1) == 0 ? pair.x : pair.y;
}

// The places of four vertex numbers in ascending order, which is how cells store corner values.
ivec4 ranksOf(ivec4 ids) {
    return ivec4(lessThan(ids.xxxx, ids)) + ivec4(lessThan(ids.yyyy, ids)) +
           ivec4(lessThan(ids.zzzz, ids)) + ivec4(lessThan(ids.wwww, ids));
}

// The gradient of a field in a cell, of any length: u, v, w lead from one corner to the others, `rise`
// is what the field gains there. Scaled, so that products of cells and values of any size stay in
// range.
vec3 gradientAlong(vec3 u, vec3 v, vec3 w, vec3 rise) {
    vec3 size = max(max(abs(u), abs(v)), abs(w));
    float scale = 1.0 / max(max(size.x, size.y), max(size.z, 1.0e-37));
    u *= scale;
    v *= scale;
    w *= scale;
    rise /= max(max(abs(rise.x), abs(rise.y)), max(abs(rise.z), 1.0e-37));
    return rise.x * cross(v, w) + rise.y * cross(w, u) + rise.z * cross(u, v);
}

// What a field whose values sit at `valuesAt` gives at the vertices `ids` of `cell`.
vec4 cornerValues(samplerBuffer values, int valuesAt, int cell, ivec4 ids) {
    if (valuesAt == kValuesAtVertices) {
        return vec4(texelFetch(values, ids.x).r, texelFetch(values, ids.y).r,
                    texelFetch(values, ids.z).r, texelFetch(values, ids.w).r);
    }
    vec4 stored = texelFetch(values, cell);
    if (valuesAt == kValuesAtCells) return vec4(stored.r);
    ivec4 ranks = ranksOf(ids);
    return vec4(pick(stored, ranks.x), pick(stored, ranks.y), pick(stored, ranks.z),
                pick(stored, ranks.w));
}
