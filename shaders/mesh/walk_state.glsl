// Where a walk is: at `depth` on the face (a, b, c) of `cell`, through which it came in.
#include "mesh/entry.glsl"

struct Walk {
    int cell;      // -1: outside the mesh
    int apex;      // the vertex of `cell` that is not on the face
    Corner a, b, c;
    vec3 weights;  // of a, b, c at the line, >= 0; areas, not divided by their sum
    float depth;
    float value;   // of the field there, as the cell before saw it
    float density; // of the second field there
    int left;      // the cell before, and its vertex that is not on the face
    Corner behind;
};

// The mean of three values by areas that are not negative, exact where the values are equal; `known`
// where the areas are all 0.
float meanOf(vec3 values, vec3 weights, float known) {
    float sum = weights.x + weights.y + weights.z;
    vec2 shares = weights.yz * (1.0 / sum);
    float mean = values.x + (shares.x * (values.y - values.x) + shares.y * (values.z - values.x));
    return sum > 0.0 ? mean : known;
}

Walk walkOn(int cell, int apex, Corner a, Corner b, Corner c, vec3 areas) {
    vec3 weights = max(areas, 0.0);
    return Walk(cell, apex, a, b, c, weights, depthOn(a, b, c, weights),
                meanOf(vec3(a.value, b.value, c.value), weights, a.value),
                meanOf(vec3(a.density, b.density, c.density), weights, a.density), -1, a);
}

Walk walkFrom(Entry entry) {
    return walkOn(entry.cell, entry.apex, entry.a, entry.b, entry.c, entry.weights);
}

Walk outside() {
    Corner none = Corner(vec2(0.0), 0.0, 0.0, 0.0, 0);
    return Walk(-1, 0, none, none, none, vec3(0.0), 0.0, 0.0, 0.0, -1, none);
}

// Tries the face (a, b, c), counter-clockwise from outside, opposite `apex`, as the one through
// which the line comes into the start cell; keeps it where it fits better than `best`.
void tryFace(inout Walk best, inout float bestFit, Corner a, Corner b, Corner c, int apex) {
    vec3 weights = vec3(areaOf(b, c), areaOf(c, a), areaOf(a, b));
    bool holds = isLeft(weights.x, b, c) && isLeft(weights.y, c, a) && isLeft(weights.z, a, b);
    // Signs name one face; should rounding near the eye leave none, the least wrong one serves.
    float fit = holds ? 3.0e38 : min(weights.x, min(weights.y, weights.z));
    if (fit <= bestFit) return;
    bestFit = fit;
    best = walkOn(meshView.start.x, apex, a, b, c, weights);
}

// In the cell that the eye is in, on the face behind the eye; outside where it is in none.
Walk atStart(Sight sight) {
    Walk best = outside();
    if (!kClipsAtStart || meshView.start.x < 0) return best;
    ivec4 ids = meshView.startVertices;
    Corner p = cornerOf(ids.x, sight);
    Corner q = cornerOf(ids.y, sight);
    Corner r = cornerOf(ids.z, sight);
    Corner s = cornerOf(ids.w, sight);
    float fit = -3.0e38;
    tryFace(best, fit, q, r, s, ids.x);
    tryFace(best, fit, p, s, r, ids.y);
    tryFace(best, fit, p, q, s, ids.z);
    tryFace(best, fit, p, r, q, ids.w);
    return best;
}
