// The part of a ray that counts, world units from its origin.
// Constants: kClipsAtStart: data reaches behind where rays start; kEndsAtSurfaces: opaque layers cut
// rays; kClipPlanes: number of clip planes.
#include "lib/layer.glsl"

struct Window {
    float begin;
    float end;
};

const bool kCutsFront = kClipsAtStart || kClipPlanes > 0;
const bool kCutsBack = kEndsAtSurfaces || kClipPlanes > 0;

// The part of [begin, end] in which the ray is on the kept side of all clip planes.
Window clipped(Window window, Ray ray) {
    for (int i = 0; i < kClipPlanes; ++i) {
        vec4 plane = layer.clipPlanes[i];
        float rise = dot(plane.xyz, ray.direction);
        float missing = plane.w - dot(plane.xyz, ray.origin);
        float at = missing / rise;
        if (rise > 0.0) window.begin = max(window.begin, at);
        if (rise < 0.0) window.end = min(window.end, at);
        if (rise == 0.0 && missing > 0.0) window.end = -kNoHit;
    }
    return window;
}

Window windowOf(Ray ray, vec2 pixel) {
    return clipped(Window(kClipsAtStart ? 0.0 : -kNoHit, opaqueDistance(pixel)), ray);
}
