// Fields' values in a cell. Constants: kValuesAt, kDensityAt: where f and g have theirs.
#include "mesh/corner_values.glsl"
#include "mesh/walk_state.glsl"

layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;

struct CellValues {
    vec3 front;  // at the corners of the face the walk came in through
    float apex;
};

// Values that a cell stores for its corners, which are ordered by vertex number.
CellValues storedIn(vec4 stored, ivec4 ids) {
    ivec4 ranks = ranksOf(ids);
    return CellValues(vec3(pick(stored, ranks.x), pick(stored, ranks.y), pick(stored, ranks.z)),
                      pick(stored, ranks.w));
}

// f at the corners a, b, c and q of `cell`.
CellValues valuesIn(int cell, Corner a, Corner b, Corner c, Corner q) {
    if (kValuesAt == kValuesAtVertices) {
        return CellValues(vec3(a.value, b.value, c.value), q.value);
    }
    vec4 stored = texelFetch(fieldValues, cell);
    if (kValuesAt == kValuesAtCells) return CellValues(vec3(stored.r), stored.r);
    return storedIn(stored, ivec4(a.id, b.id, c.id, q.id));
}

// The same of g.
CellValues densitiesIn(int cell, Corner a, Corner b, Corner c, Corner q) {
    if (kDensityAt == kValuesNowhere) return CellValues(vec3(0.0), 0.0);
    if (kDensityAt == kValuesAtVertices) {
        return CellValues(vec3(a.density, b.density, c.density), q.density);
    }
    vec4 stored = texelFetch(densityValues, cell);
    if (kDensityAt == kValuesAtCells) return CellValues(vec3(stored.r), stored.r);
    return storedIn(stored, ivec4(a.id, b.id, c.id, q.id));
}

// The value on a face; `known` where the face is seen edge-on and has no weights.
float valueOn(int valuesAt, vec3 values, vec3 weights, float known) {
    return valuesAt == kValuesAtCells ? values.x : meanOf(values, weights, known);
}

// |cosine| between a line of `slope` and the gradient of f in a cell of which corners and values
// are known. The line only shears the corners, so the gradient's part along it is that along depth.
float facingIn(Corner a, Corner b, Corner c, Corner q, CellValues values, vec2 slope) {
    vec3 origin = vec3(q.at, q.depth);
    vec3 u = vec3(a.at, a.depth) - origin;
    vec3 v = vec3(b.at, b.depth) - origin;
    vec3 w = vec3(c.at, c.depth) - origin;
    vec3 sheared = gradientAlong(u, v, w, values.front - values.apex);
    vec3 gradient = vec3(sheared.xy, sheared.z - dot(slope, sheared.xy));
    float length2 = dot(gradient, gradient) * (1.0 + dot(slope, slope));
    return length2 > 0.0 ? min(abs(sheared.z) * inversesqrt(length2), 1.0) : 0.0;
}
