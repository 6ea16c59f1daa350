// What the values of several channels near a point are within: see volume/ranges.glsl.
// Constants: kRangeBlock; kTricubicOvershoot; those of volume/channels.glsl.
#include "volume/channels.glsl"

layout(binding = kBrickUnit) uniform samplerBuffer channelRanges;  // a block: smallest, then largest

struct ChannelRanges {
    vec4 low, high;
};

ivec3 lastChannelBlock = lastChannelPoint() / kRangeBlock;

// The ranges of all values within kRangeReach of a point in the box, along each axis.
ChannelRanges rangesAround(vec3 at) {
    ivec3 block = clamp(ivec3(at) / kRangeBlock, ivec3(0), lastChannelBlock);
    int index = (block.z * (lastChannelBlock.y + 1) + block.y) * (lastChannelBlock.x + 1) + block.x;
    vec4 low = texelFetch(channelRanges, 2 * index), high = texelFetch(channelRanges, 2 * index + 1);
    vec4 overshoot = kSampling == kTricubic ? kTricubicOvershoot * (high - low) : vec4(0.0);
    return ChannelRanges(low - overshoot, high + overshoot);
}
