// `v` at length 1, without overflow; 0 for 0.
vec3 unit(vec3 v) {
    float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return size > 0.0 ? normalize(v / size) : vec3(0.0);
}
