// A number in [0, 1) of a pixel and a seed; the same on every machine, as it is all integers.
// Source: M. Jarzynski, M. Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020 (pcg3d).
float shareOf(uvec2 pixel, uint seed) {
    uvec3 v = uvec3(pixel, seed) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return float(v.x >> 8u) * (1.0 / 16777216.0);
}
