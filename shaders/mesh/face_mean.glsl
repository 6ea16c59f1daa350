// Values and depths where a line crosses a face, from those of its corners and the areas that weigh
// them. Both cells of a face get the same bits, in whatever order they name its corners: no line
// ever falls between the levels that the two see.

// The sum of three numbers, in an order that depends on the numbers alone.
float sumOf(vec3 v) {
    float low = min(v.x, min(v.y, v.z));
    float high = max(v.x, max(v.y, v.z));
    float middle = max(min(v.x, v.y), min(max(v.x, v.y), v.z));
    precise float sum = (low + high) + middle;
    return sum;
}

// The mean of three values by areas that are not negative, between the values also after rounding,
// so that a constant field stays constant; `known` where the areas are all 0.
float faceMean(vec3 values, vec3 weights, float known) {
    float sum = sumOf(weights);
    precise vec3 parts = weights * values;
    float mean = sumOf(parts) / sum;
    float low = min(values.x, min(values.y, values.z));
    float high = max(values.x, max(values.y, values.z));
    return sum > 0.0 ? clamp(mean, low, high) : known;
}
