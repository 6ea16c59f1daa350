// Rays that march through several channels of a volume, each in the colours of its own map, blended
// over what is there. Equal steps over the exact length of the ray in the box; a step's matter is
// that in its middle.
//
// Where matter of several channels is in one place, extinctions add up, and each emits its colour
// times its extinction: that is what many small grains of each would do. Of maxima and minima each
// channel has its own, and their colours add up.
// Constants: kChannels, 1 to 4; kGathers: what of the model; kEarlyStop; kMaxRaySamples; those of
// lib/window.glsl, volume/channels.glsl and classify/channel_maps.glsl.
#include "contract/segment.glsl"
#include "lib/box.glsl"
#include "lib/finished.glsl"
#include "lib/window.glsl"
#include "classify/channel_maps.glsl"
#include "volume/channels.glsl"

const int kVolume = 0;
const int kMip = 1;
const int kMinip = 2;
const int kXray = 3;

layout(location = 0) out vec4 colour;

ChannelMap map0 = channelMap(0);
ChannelMap map1 = channelMap(min(1, kChannels - 1));
ChannelMap map2 = channelMap(min(2, kChannels - 1));
ChannelMap map3 = channelMap(min(3, kChannels - 1));

// Emission (colour times extinction) and extinction.
vec4 emissionOf(vec4 matter) {
    return vec4(matter.rgb * matter.a, matter.a);
}

// Written out: loops would soon meet the limit of llvmpipe.
vec4 emissionAt(vec4 values) {
    vec4 sum = emissionOf(matterOf(map0, values.x));
    if (kChannels > 1) sum += emissionOf(matterOf(map1, values.y));
    if (kChannels > 2) sum += emissionOf(matterOf(map2, values.z));
    if (kChannels > 3) sum += emissionOf(matterOf(map3, values.w));
    return sum;
}

vec3 coloursOf(vec4 values) {
    vec3 sum = matterOf(map0, values.x).rgb;
    if (kChannels > 1) sum += matterOf(map1, values.y).rgb;
    if (kChannels > 2) sum += matterOf(map2, values.z).rgb;
    if (kChannels > 3) sum += matterOf(map3, values.w).rgb;
    return sum;
}

// The share that depth takes away: 1 - exp(-depth), to the last digits of thin matter too.
float opacityOf(float depth) {
    return depth < 1.0e-3 ? depth * (1.0 - depth * (0.5 - depth / 6.0)) : 1.0 - exp(-depth);
}

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    Window window = windowOf(ray, gl_FragCoord.xy);
    vec3 origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(layer.gridFromData) * ray.direction;
    vec2 span = boxSpan(origin, direction, vec3(0.0), layer.grid.xyz - 1.0);
    float begin = max(span.x, window.begin), end = min(span.y, window.end);
    bool met = begin <= end;
    float steps = met ? clamp(ceil((end - begin) / layer.grid.w), 1.0, float(kMaxRaySamples)) : 0.0;
    float dt = met ? (end - begin) / steps : 0.0;
    vec4 largest = vec4(-3.4e38), smallest = vec4(3.4e38);
    vec3 light = vec3(0.0);
    float opacity = 0.0, depth = 0.0;
    for (float i = 0.0; i < steps; i += 1.0) {
        vec4 values = channelsAt(origin + (begin + (i + 0.5) * dt) * direction);
        if (kGathers == kMip) largest = max(largest, values);
        if (kGathers == kMinip) smallest = min(smallest, values);
        if (kGathers == kMip || kGathers == kMinip) continue;
        vec4 emission = emissionAt(values);
        if (kGathers == kXray) depth += emission.a * dt;
        if (kGathers == kXray || !(emission.a > 0.0)) continue;
        float share = (1.0 - opacity) * opacityOf(emission.a * dt);
        light += share / emission.a * emission.rgb;
        opacity += share;
        if (kEarlyStop && opacity > kFinishedOpacity) break;
    }
    colour = vec4(light, opacity);
    if (kGathers == kXray) colour = vec4(vec3(exp(-layer.gather.x * depth)), 1.0);
    if (kGathers == kMip) colour = met ? vec4(coloursOf(largest), 1.0) : vec4(0.0);
    if (kGathers == kMinip) colour = met ? vec4(coloursOf(smallest), 1.0) : vec4(0.0);
}
