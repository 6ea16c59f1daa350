// Up to four channels of a volume between their grid points, in grid coordinates: the components of
// one texture, so that a fetch reads all of them.
// Constants: kSampling, kFilterInHardware (trilinear by the texture unit), kMissing.
#include "lib/layer.glsl"
#include "lib/unit.glsl"

layout(binding = kVoxelUnit) uniform sampler3D channelVoxels;

const int kNearest = 0;
const int kTricubic = 2;

// Computed before any loop, because llvmpipe reads a uniform again in each round: see
// classify/transfer_function.glsl.
mat3 worldFromSlope = transpose(mat3(layer.gridFromData)) + max(-gl_FragCoord.x, 0.0);

ivec3 lastChannelPoint() {
    return ivec3(layer.grid.xyz) - 1;
}

vec4 channelVoxel(ivec3 point) {
    return texelFetch(channelVoxels, clamp(point, ivec3(0), lastChannelPoint()), 0);
}

// The first grid point of the cell that holds `at`.
ivec3 channelCell(vec3 at) {
    return clamp(ivec3(floor(at)), ivec3(0), max(lastChannelPoint() - 1, ivec3(0)));
}

vec4 channelLine(ivec3 low, vec2 weights) {
    return weights.x * channelVoxel(low) + weights.y * channelVoxel(low + ivec3(1, 0, 0));
}

vec4 trilinearChannels(vec3 at) {
    ivec3 low = channelCell(at);
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec2 x = vec2(1.0 - t.x, t.x);
    vec4 front = mix(channelLine(low, x), channelLine(low + ivec3(0, 1, 0), x), t.y);
    vec4 back = mix(channelLine(low + ivec3(0, 0, 1), x), channelLine(low + ivec3(0, 1, 1), x), t.y);
    return mix(front, back, t.z);
}

// Catmull-Rom: as in volume/voxels.glsl.
vec4 channelCubicWeights(float t) {
    return 0.5 * vec4(((2.0 - t) * t - 1.0) * t, (3.0 * t - 5.0) * t * t + 2.0,
                      ((4.0 - 3.0 * t) * t + 1.0) * t, (t - 1.0) * t * t);
}

vec4 channelCubicLine(ivec3 low, vec4 weights) {
    return weights.x * channelVoxel(low - ivec3(1, 0, 0)) + weights.y * channelVoxel(low) +
           weights.z * channelVoxel(low + ivec3(1, 0, 0)) + weights.w * channelVoxel(low + ivec3(2, 0, 0));
}

vec4 channelCubicPlane(ivec3 low, vec4 x, vec4 y) {
    return y.x * channelCubicLine(low - ivec3(0, 1, 0), x) + y.y * channelCubicLine(low, x) +
           y.z * channelCubicLine(low + ivec3(0, 1, 0), x) + y.w * channelCubicLine(low + ivec3(0, 2, 0), x);
}

vec4 tricubicChannels(vec3 at) {
    ivec3 low = channelCell(at);
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 x = channelCubicWeights(t.x), y = channelCubicWeights(t.y), z = channelCubicWeights(t.z);
    return z.x * channelCubicPlane(low - ivec3(0, 0, 1), x, y) + z.y * channelCubicPlane(low, x, y) +
           z.z * channelCubicPlane(low + ivec3(0, 0, 1), x, y) +
           z.w * channelCubicPlane(low + ivec3(0, 0, 2), x, y);
}

// The values of all channels at grid coordinates `at`.
vec4 channelsAt(vec3 at) {
    if (kSampling == kNearest) return channelVoxel(ivec3(floor(at + 0.5)));
    if (kSampling == kTricubic) return tricubicChannels(at);
    return kFilterInHardware ? textureLod(channelVoxels, (at + 0.5) / layer.grid.xyz, 0.0)
                             : trilinearChannels(at);
}

// How fast each channel rises along `axis`, by central differences over a grid interval to each side;
// at a face of the box, and beside voxels without a value, one side is shorter.
vec4 channelSlopes(int axis, vec3 at) {
    vec3 low = at, high = at;
    low[axis] = max(at[axis] - 1.0, 0.0);
    high[axis] = min(at[axis] + 1.0, layer.grid[axis] - 1.0);
    vec4 below = channelsAt(low), above = channelsAt(high);
    vec4 from = vec4(low[axis]), to = vec4(high[axis]);
    if (kMissing) {
        vec4 own = channelsAt(at);
        from = mix(from, vec4(at[axis]), isnan(below));
        to = mix(to, vec4(at[axis]), isnan(above));
        below = mix(below, own, isnan(below));
        above = mix(above, own, isnan(above));
    }
    // Quarters, because the difference of two large values may not be a number.
    return (0.25 * above - 0.25 * below) / max(to - from, vec4(0.5));
}

// The direction in which each channel rises most, of length 1 in the world; 0 where it is flat.
mat4x3 channelNormals(vec3 at) {
    vec4 x = channelSlopes(0, at), y = channelSlopes(1, at), z = channelSlopes(2, at);
    return mat4x3(unit(worldFromSlope * scaledToOne(vec3(x.x, y.x, z.x))),
                  unit(worldFromSlope * scaledToOne(vec3(x.y, y.y, z.y))),
                  unit(worldFromSlope * scaledToOne(vec3(x.z, y.z, z.z))),
                  unit(worldFromSlope * scaledToOne(vec3(x.w, y.w, z.w))));
}
