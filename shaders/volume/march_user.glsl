// Marches through a voxel volume and asks a user's code in the middle of each step. Equal steps over
// the exact length of the ray in the box; nothing is skipped, because nobody knows what the code
// shows of a value; where the layer's own channel has no value it is not asked.
// Constants: kEarlyStop, kMaxRaySamples; kInterval: only values in an interval count; those of
// lib/window.glsl and volume/user_voxels.glsl.
// Uses: model.
#include "lib/box.glsl"
#include "lib/window.glsl"
#include "volume/missing.glsl"
#include "volume/user_voxels.glsl"

layout(location = 0) out vec4 colour;

void main() {
    Ray ray = rayThrough(gl_FragCoord.xy);
    Window window = windowOf(ray, gl_FragCoord.xy);
    vec3 origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(layer.gridFromData) * ray.direction;
    vec2 span = boxSpan(origin, direction, vec3(0.0), layer.grid.xyz - 1.0);
    float begin = max(span.x, window.begin);
    float end = min(span.y, window.end);
    RayState state = beginRay(ray);
    float steps = begin <= end ? clamp(ceil((end - begin) / layer.grid.w), 1.0, float(kMaxRaySamples))
                               : 0.0;
    float dt = (end - begin) / steps;
    for (int i = 0; i < int(steps); ++i) {
        sampleAt = origin + (begin + (float(i) + 0.5) * dt) * direction;
        float value = sampledValue(kOwnChannel);
        if (lacksValue(value)) continue;
        float inInterval = value - codeHeader.y;  // as the layer's block has it
        if (kInterval && (inInterval < layer.gather.z || inInterval > layer.gather.w)) continue;
        Segment piece = Segment(value, value, value, value, dt, begin + float(i) * dt);
        if (stepRay(state, piece) && kEarlyStop) break;
    }
    colour = endRay(state, 1.0);
}
