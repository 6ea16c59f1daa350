// Planes across the axes of a grid, in the colours that a user's code emits there; where that is
// transparent they are looked through. Each pixel shows the nearest that is not.
// Constants: kInterval: only values in an interval are shown; those of lib/window.glsl and
// volume/user_voxels.glsl.
// Uses: classify (user_code.glsl).
#include "lib/depth.glsl"
#include "lib/window.glsl"
#include "volume/missing.glsl"
#include "volume/user_voxels.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

// Places the sample where `ray` meets the plane across `axis`; false: it does not.
bool meets(int axis, Ray ray, Window window, out float distance) {
    vec3 origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(layer.gridFromData) * ray.direction;
    distance = (layer.sections[axis] - origin[axis]) / direction[axis];
    if (!(distance >= window.begin && distance <= window.end)) return false;
    sampleAt = origin + distance * direction;
    sampleAt[axis] = layer.sections[axis];
    return !any(lessThan(sampleAt, vec3(0.0))) &&
           !any(greaterThan(sampleAt, layer.grid.xyz - 1.0));
}

// What the code shows at the sample; transparent where the layer's own value does not count.
vec4 shownAtSample() {
    float value = sampledValue(kOwnChannel);
    if (lacksValue(value)) return vec4(0.0);
    float inInterval = value - codeHeader.y;  // as the layer's block has it
    if (kInterval && !(inInterval >= layer.gather.z && inInterval <= layer.gather.w)) return vec4(0.0);
    return emissionAt(value).colour;
}

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    Window window = windowOf(ray, gl_FragCoord.xy);
    distanceOut = kNoHit;
    for (int axis = 0; axis < 3; ++axis) {
        float distance;
        bool shown = (int(layer.sections.w) >> axis & 1) == 1;
        if (!shown || !meets(axis, ray, window, distance) || distance >= distanceOut) continue;
        vec4 emitted = shownAtSample();
        if (emitted.a <= 0.0) continue;
        distanceOut = distance;
        colour = vec4(emitted.rgb, 1.0);
    }
    if (distanceOut >= kNoHit) discard;
    gl_FragDepth = depthAt(ray, distanceOut);
}
