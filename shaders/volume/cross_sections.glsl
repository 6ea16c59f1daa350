// Planes across the axes of a grid, in the colours of the map; each pixel shows the nearest one.
// Constants: kInterval: only values in an interval are shown; those of lib/window.glsl and
// volume/voxels.glsl.
// Uses: classify.
#include "lib/depth.glsl"
#include "lib/window.glsl"
#include "volume/voxels.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

// The value on the plane across `axis`, where `ray` meets it; false: it does not, or nothing shows there.
bool meets(int axis, Ray ray, Window window, out float distance, out float value) {
    vec3 origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(layer.gridFromData) * ray.direction;
    distance = (layer.sections[axis] - origin[axis]) / direction[axis];
    if (!(distance >= window.begin && distance <= window.end)) return false;
    vec3 at = origin + distance * direction;
    at[axis] = layer.sections[axis];
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, layer.grid.xyz - 1.0))) return false;
    value = valueAt(at);
    if (lacksValue(value)) return false;
    return !kInterval || (value >= layer.gather.z && value <= layer.gather.w);
}

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    Window window = windowOf(ray, gl_FragCoord.xy);
    distanceOut = kNoHit;
    float shownValue = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        float distance, value;
        bool shown = (int(layer.sections.w) >> axis & 1) == 1;
        if (!shown || !meets(axis, ray, window, distance, value) || distance >= distanceOut) continue;
        distanceOut = distance;
        shownValue = value;
    }
    if (distanceOut >= kNoHit) discard;
    colour = vec4(classify(shownValue).rgb, 1.0);
    gl_FragDepth = depthAt(ray, distanceOut);
}
