float largestSize(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// `v` at length 1, without overflow; 0 for 0.
vec3 unit(vec3 v) {
    float size = largestSize(v);
    return size > 0.0 ? normalize(v / size) : vec3(0.0);
}

// `v` with its largest component at 1 or -1; 0 for less than the least normal number.
vec3 scaledToOne(vec3 v) {
    return v / max(largestSize(v), 1.1754944e-38);
}
