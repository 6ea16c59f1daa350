// Depth of a point of a ray in the depth buffer that opaque layers share.
#include "lib/layer.glsl"

float depthAt(Ray ray, float distance) {
    vec4 clip = layer.clipFromData * vec4(ray.origin + distance * ray.direction, 1.0);
    return clamp(clip.z / clip.w, 0.0, 1.0);
}
