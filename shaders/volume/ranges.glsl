// What the values near a point are within: see renderer/volume/block_ranges.h.
// Constants: kRangeBlock; kTricubicOvershoot; those of volume/voxels.glsl.
#include "volume/voxels.glsl"

layout(binding = kBrickUnit) uniform samplerBuffer blockRanges;  // the smallest value, then the largest

ivec3 lastBlock = lastPoint() / kRangeBlock;

// The range of all values within kRangeReach of a point in the box, along each axis.
//
// Tricubic values are sums over voxels. Along an axis the weights below 0 add up to -t (1 - t) / 2, so
// that all their sizes do to 1 + t (1 - t) <= 5/4; along three to 125/64. All weights add up to 1:
// those below 0 to -N and those above to 1 + N with 1 + 2 N <= 125/64, N <= 61/128. Values are then
// between low - N (high - low) and high + N (high - low); kTricubicOvershoot, 0.48, is more than N by
// more than all rounding.
vec2 rangeAround(vec3 at) {
    ivec3 block = clamp(ivec3(at) / kRangeBlock, ivec3(0), lastBlock);
    int index = (block.z * (lastBlock.y + 1) + block.y) * (lastBlock.x + 1) + block.x;
    // One by one, so that what a model does not ask for is not read.
    vec2 range = vec2(texelFetch(blockRanges, 2 * index).r, texelFetch(blockRanges, 2 * index + 1).r);
    float overshoot = kSampling == kTricubic ? kTricubicOvershoot * (range.y - range.x) : 0.0;
    return range + vec2(-overshoot, overshoot);
}
