// Rays that march through several channels of a volume, each in the colours of its own map, blended
// over what is there. By the steps of volume/steps.glsl; a step's matter is that of one sample in it, by
// default in its middle. Steps that cannot add to the ray, because no channel can, are passed over as in
// volume/march_ray.glsl.
//
// Where matter of several channels is in one place, extinctions add up, and each emits its colour
// times its extinction: that is what many small grains of each would do. A light falls on each by the
// slope of its own field, before they are added. Of maxima and minima each channel has its own, and
// their colours add up.
// Constants: kChannels, 1 to 4; kGathers: what of the model; kEarlyStop; kSkipBricks; kShaded; kInterval:
// channels have intervals; kMissing: voxels may have no value; those of volume/steps.glsl,
// volume/channel_ranges.glsl and classify/channel_maps.glsl.
#include "contract/segment.glsl"
#include "lib/finished.glsl"
#include "lib/light.glsl"
#include "classify/channel_maps.glsl"
#include "volume/channel_ranges.glsl"
#include "volume/steps.glsl"

const int kVolume = 0;
const int kMip = 1;
const int kMinip = 2;
const int kXray = 3;
const bool kExtremes = kGathers == kMip || kGathers == kMinip;
const float kNothing = 3.4e38;

layout(location = 0) out vec4 colour;

ChannelMap map0 = channelMap(0);
ChannelMap map1 = channelMap(min(1, kChannels - 1));
ChannelMap map2 = channelMap(min(2, kChannels - 1));
ChannelMap map3 = channelMap(min(3, kChannels - 1));
vec4 lowest = texelFetch(mapTexels, 1), highest = texelFetch(mapTexels, 2);

// What a ray has gathered.
struct Gathered {
    vec3 light;
    float opacity, depth;
    vec4 extremes;  // largest or smallest values, +-kNothing where there was none
};

// Which of the channels have a value that counts.
bvec4 counted(vec4 values) {
    bvec4 counts = bvec4(true);
    if (kInterval) {
        bvec4 above = greaterThanEqual(values, lowest), below = lessThanEqual(values, highest);
        counts = bvec4(above.x && below.x, above.y && below.y, above.z && below.z, above.w && below.w);
    }
    if (kMissing) counts = mix(counts, bvec4(false), isnan(values));
    return counts;
}

vec4 matterIn(ChannelMap map, float value, bool counts) {
    return counts ? matterOf(map, value) : vec4(0.0);
}

// Emission (colour times extinction) and extinction.
vec4 emissionOf(vec4 matter, vec3 normal, vec3 position, vec3 towardsEye) {
    if (!kShaded) return vec4(matter.rgb * matter.a, matter.a);
    vec2 light = lightOn(normal, position, towardsEye);
    return vec4((matter.rgb * light.x + light.y) * matter.a, matter.a);
}

// Matter of all channels at a place. Written out: loops would soon meet the limit of llvmpipe.
struct Matters {
    vec4 of0, of1, of2, of3;
    float extinction;  // of all
};

Matters mattersOf(vec4 values) {
    bvec4 counts = counted(values);
    Matters matters = Matters(matterIn(map0, values.x, counts.x), vec4(0.0), vec4(0.0), vec4(0.0), 0.0);
    if (kChannels > 1) matters.of1 = matterIn(map1, values.y, counts.y);
    if (kChannels > 2) matters.of2 = matterIn(map2, values.z, counts.z);
    if (kChannels > 3) matters.of3 = matterIn(map3, values.w, counts.w);
    matters.extinction = matters.of0.a + matters.of1.a + matters.of2.a + matters.of3.a;
    return matters;
}

vec4 emissionAt(vec4 values, vec3 at, vec3 position, vec3 towardsEye) {
    Matters matters = mattersOf(values);
    mat4x3 normals = mat4x3(0.0);
    if (kShaded) normals = channelNormals(at);
    vec4 sum = emissionOf(matters.of0, normals[0], position, towardsEye);
    if (kChannels > 1) sum += emissionOf(matters.of1, normals[1], position, towardsEye);
    if (kChannels > 2) sum += emissionOf(matters.of2, normals[2], position, towardsEye);
    if (kChannels > 3) sum += emissionOf(matters.of3, normals[3], position, towardsEye);
    return sum;
}

// The colours of extremes, added up, of channels that have any.
vec4 coloursOf(vec4 values) {
    bvec4 met = lessThan(abs(values), vec4(kNothing));
    vec3 sum = matterIn(map0, values.x, met.x).rgb;
    if (kChannels > 1) sum += matterIn(map1, values.y, met.y).rgb;
    if (kChannels > 2) sum += matterIn(map2, values.z, met.z).rgb;
    if (kChannels > 3) sum += matterIn(map3, values.w, met.w).rgb;
    bool any = met.x || kChannels > 1 && met.y || kChannels > 2 && met.z || kChannels > 3 && met.w;
    return any ? vec4(sum, 1.0) : vec4(0.0);
}

// The share that depth takes away: 1 - exp(-depth), to the last digits of thin matter too.
float opacityOf(float depth) {
    return depth < 1.0e-3 ? depth * (1.0 - depth * (0.5 - depth / 6.0)) : 1.0 - exp(-depth);
}

// Takes a sample for a step. True: nothing behind can show.
bool takeSample(inout Gathered gathered, vec4 values, vec3 at, vec3 position, vec3 towardsEye, float dt) {
    if (kExtremes) {
        vec4 none = vec4(kGathers == kMip ? -kNothing : kNothing);
        if (kInterval || kMissing) values = mix(none, values, counted(values));
        gathered.extremes = kGathers == kMip ? max(gathered.extremes, values) : min(gathered.extremes, values);
        return false;
    }
    vec4 emission = emissionAt(values, at, position, towardsEye);
    gathered.depth += emission.a * dt;
    if (kGathers == kXray || !(emission.a > 0.0)) return false;
    float taken = (1.0 - gathered.opacity) * opacityOf(emission.a * dt);
    gathered.light += taken / emission.a * emission.rgb;
    gathered.opacity += taken;
    return kEarlyStop && gathered.opacity > kFinishedOpacity;
}

// Whether a channel adds nothing by values from `low` to `high`.
bool addsNothing(ChannelMap map, float low, float high, float extreme) {
    if (low > high) return true;
    if (kGathers == kMip) return high <= extreme;
    if (kGathers == kMinip) return low >= extreme;
    return transparentBetween(map, low, high);
}

bool allAddNothing(Gathered gathered, ChannelRanges ranges) {
    if (kInterval) ranges.low = max(ranges.low, lowest);
    if (kInterval) ranges.high = min(ranges.high, highest);
    bool nothing = addsNothing(map0, ranges.low.x, ranges.high.x, gathered.extremes.x);
    if (kChannels > 1) nothing = nothing && addsNothing(map1, ranges.low.y, ranges.high.y, gathered.extremes.y);
    if (kChannels > 2) nothing = nothing && addsNothing(map2, ranges.low.z, ranges.high.z, gathered.extremes.z);
    if (kChannels > 3) nothing = nothing && addsNothing(map3, ranges.low.w, ranges.high.w, gathered.extremes.w);
    return nothing;
}

// Takes the steps from `i` to `beyond`, or until nothing behind can show. Under a light each ray first goes
// on to its next sample with matter: see takeLitSteps() in volume/march_ray.glsl.
bool takeSteps(inout Gathered gathered, Ray ray, March march, inout int i, int beyond) {
    bool finished = false;
    do {
        float distance = 0.0;
        vec4 values = vec4(0.0);
        bool seen = true;
        do {
            distance = distanceOf(march, float(i) + share);
            values = channelsAt(positionAt(march, distance));
            if (kShaded) seen = mattersOf(values).extinction > 0.0;
            i += seen ? 0 : 1;
        } while (!seen && i < beyond);
        if (seen) {
            finished = takeSample(gathered, values, positionAt(march, distance),
                                  ray.origin + distance * ray.direction, -ray.direction, march.dt);
            ++i;
        }
    } while (i < beyond && !finished);
    return finished;
}

// Where the steps end that are to be passed over, or taken, together with step `i`.
int beyondAlike(Gathered gathered, March march, int i, int together, out bool shows) {
    if (!kByDistance) {
        float middle = distanceOf(march, float(i) + 0.5 * float(together));
        shows = !allAddNothing(gathered, rangesAround(positionAt(march, middle)));
        return i + together;
    }
    int empty = emptySteps(march, float(i) + share, true);
    shows = empty == 0;
    return i + (shows ? together : empty);
}

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    March march;
    meetsBox(ray, windowOf(ray, gl_FragCoord.xy), march);
    Gathered gathered = Gathered(vec3(0.0), 0.0, 0.0, vec4(kGathers == kMip ? -kNothing : kNothing));
    // As many steps are looked at together as ranges reach over; longer ones reach farther.
    int together = stepsTogether(march);
    vec3 step = abs(march.direction) * march.dt;
    bool skips = kByDistance || max(step.x, max(step.y, step.z)) <= 2.0 * float(kRangeReach);
    bool finished = march.first >= march.steps;
    int i = march.first;
    if (!finished) {
        do {
            int beyond = march.steps;
            bool shows = true;
            if (kSkipBricks) {
                do {
                    beyond = min(skips ? beyondAlike(gathered, march, i, together, shows) : i + together,
                                 march.steps);
                    i = shows ? i : beyond;
                } while (!shows && i < march.steps);
            }
            if (shows) finished = takeSteps(gathered, ray, march, i, beyond);
        } while (i < march.steps && !finished);
    }
    colour = vec4(gathered.light, gathered.opacity);
    if (kGathers == kXray) colour = vec4(vec3(exp(-layer.gather.x * gathered.depth)), 1.0);
    if (kExtremes) colour = coloursOf(gathered.extremes);
}
