// The field of a channel between its grid points, in grid coordinates.
// Constants: kSampling; kTexels, what a texel holds (VoxelTexels in renderer/volume/voxel_blocks.h);
// kFilterInHardware: trilinear by the texture unit, where a texture holds the voxels.
//
// On llvmpipe a fetch costs about as much as interpolation, so a texel holds as many values of
// integers as its 4 bytes have room for, and texels lie in blocks of 4^3 grid points.
#include "lib/layer.glsl"
#include "lib/unit.glsl"
#include "volume/missing.glsl"

// One of these is read; both are at one texture unit.
layout(binding = kVoxelUnit) uniform sampler3D voxelTexture;
layout(binding = kVoxelUnit) uniform usamplerBuffer voxelWords;

const int kNearest = 0;
const int kTrilinear = 1;
const int kTricubic = 2;

const int kTexture = 0;
const int kFaces8 = 1;
const int kPairsU16 = 2;
const int kPairsI16 = 3;

// Computed before any loop, because llvmpipe reads a uniform again in each round: see
// classify/transfer_function.glsl.
ivec3 gridLast = ivec3(layer.grid.xyz + max(-gl_FragCoord.x, 0.0)) - 1;
ivec2 blocks = (gridLast.xy + 5) / 4 | 1;
// Texels from one block to the next, less those that are counted within a block.
int nextRow = 64 * blocks.x - 16;
int nextLayer = 64 * blocks.x * blocks.y - 64;

ivec3 lastPoint() {
    return gridLast;
}

// The texel of grid point (x, y, z) is the sum of three; as BlockLayout says.
int texelOfX(int x) {
    return x + (x >> 2) * 60;
}

int texelOfY(int y) {
    return 4 * y + (y >> 2) * nextRow;
}

int texelOfZ(int z) {
    return 16 * z + (z >> 2) * nextLayer;
}

vec4 bytesOf(uint word) {
    return vec4(word & 255u, word >> 8 & 255u, word >> 16 & 255u, word >> 24);
}

vec2 pairOf(uint word) {
    return kTexels == kPairsI16 ? vec2(int(word << 16) >> 16, int(word) >> 16)
                                : vec2(word & 65535u, word >> 16);
}

vec4 textureFace(ivec3 low) {
    ivec3 high = min(low + 1, lastPoint());
    low = min(low, lastPoint());
    return vec4(texelFetch(voxelTexture, low, 0).r, texelFetch(voxelTexture, ivec3(high.x, low.yz), 0).r,
                texelFetch(voxelTexture, ivec3(low.x, high.y, low.z), 0).r,
                texelFetch(voxelTexture, ivec3(high.xy, low.z), 0).r);
}

// The values at (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1) of layer z. Beyond the last point
// of an axis its value goes on; `low` is at most that point, z one more.
vec4 face(ivec3 low) {
    if (kTexels == kTexture) return textureFace(low);
    int row = texelOfX(low.x) + texelOfZ(low.z);
    uint word = texelFetch(voxelWords, row + texelOfY(low.y)).r;
    if (kTexels == kFaces8) return bytesOf(word);
    return vec4(pairOf(word), pairOf(texelFetch(voxelWords, row + texelOfY(low.y + 1)).r));
}

float voxel(ivec3 point) {
    return face(point).x;
}

// `at` is in the box, up to rounding: what lies a hair outside is extrapolated by as much.
float trilinear(vec3 at) {
    ivec3 low = ivec3(at);
    // What is missing is so for all of a cell: a place on a face of the box is in the cell behind it.
    if (kMissing) low = min(low, max(lastPoint() - 1, ivec3(0)));
    vec3 t = at - vec3(low);
    vec4 plane = mix(face(low), face(ivec3(low.xy, low.z + 1)), t.z);
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// Weights of the grid points at -1, 0, 1 and 2 for the value at t in [0, 1]: Catmull-Rom, which
// keeps the values of grid points and reproduces quadratics. Beyond a face the value on it goes on.
// Source: R. Keys, Cubic Convolution Interpolation for Digital Image Processing, IEEE Transactions
// on Acoustics, Speech, and Signal Processing 29(6), 1981, with a = -1/2.
vec4 cubicWeights(float t) {
    return 0.5 * vec4(((2.0 - t) * t - 1.0) * t, (3.0 * t - 5.0) * t * t + 2.0,
                      ((4.0 - 3.0 * t) * t + 1.0) * t, (t - 1.0) * t * t);
}

// A point's value and that of the point after it; below the first point its own value goes on.
vec2 pairFrom(int point, vec2 pair) {
    return point < 0 ? pair.xx : pair;
}

// Sixteen values of layer z around a cell: column i is row i of y, x runs along it.
mat4 rowsAround(ivec2 low, int z) {
    ivec2 before = low - 1, after = min(low + 1, lastPoint().xy);
    ivec2 first = max(before, ivec2(0));
    vec4 a = face(ivec3(first, z)), b = face(ivec3(after.x, first.y, z));
    vec4 c = face(ivec3(first.x, after.y, z)), d = face(ivec3(after, z));
    vec4 row0 = vec4(pairFrom(before.x, a.xy), b.xy), row1 = vec4(pairFrom(before.x, a.zw), b.zw);
    row1 = before.y < 0 ? row0 : row1;
    return mat4(row0, row1, vec4(pairFrom(before.x, c.xy), d.xy), vec4(pairFrom(before.x, c.zw), d.zw));
}

// The same, weighted.
float cubicPlane(ivec2 low, vec4 x, vec4 y, int z) {
    return dot(y, x * rowsAround(low, clamp(z, 0, lastPoint().z)));
}

// Written out: loops would soon meet the limit of llvmpipe.
float tricubic(vec3 at) {
    ivec3 low = clamp(ivec3(at), ivec3(0), max(lastPoint() - 1, ivec3(0)));
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 x = cubicWeights(t.x), y = cubicWeights(t.y);
    return dot(cubicWeights(t.z),
               vec4(cubicPlane(low.xy, x, y, low.z - 1), cubicPlane(low.xy, x, y, low.z),
                    cubicPlane(low.xy, x, y, low.z + 1), cubicPlane(low.xy, x, y, low.z + 2)));
}

// The value at grid coordinates `at`, in the box.
float valueAt(vec3 at) {
    if (kSampling == kNearest) return voxel(clamp(ivec3(floor(at + 0.5)), ivec3(0), lastPoint()));
    if (kSampling == kTricubic) return tricubic(at);
    if (kTexels == kTexture && kFilterInHardware) {
        return textureLod(voxelTexture, (at + 0.5) / layer.grid.xyz, 0.0).r;
    }
    return trilinear(at);
}

// Steps of a ray that a sample stands for, from `at` on: all voxels are equally fine.
int stepsASample(vec3 at, vec3 step) {
    return 1;
}

// The direction in the world in which a field rises most that has these values above and below along
// each axis, so many grid intervals apart.
vec3 normalOf(vec3 extent, vec3 above, vec3 below) {
    // Quarters, because the difference of two large values may not be a number.
    vec3 slope = (0.25 * above - 0.25 * below) / max(extent, vec3(0.5));
    return unit(transpose(mat3(layer.gridFromData)) * unit(slope));
}

// The direction in which the field rises most, of length 1 in the world; 0 where it is flat. By
// central differences over a grid interval to each side; at a face of the box one side is shorter.
vec3 normalAt(vec3 at) {
    vec3 low = max(at - 1.0, vec3(0.0));
    vec3 high = min(at + 1.0, layer.grid.xyz - 1.0);
    vec3 above = vec3(valueAt(vec3(high.x, at.yz)), valueAt(vec3(at.x, high.y, at.z)),
                      valueAt(vec3(at.xy, high.z)));
    vec3 below = vec3(valueAt(vec3(low.x, at.yz)), valueAt(vec3(at.x, low.y, at.z)),
                      valueAt(vec3(at.xy, low.z)));
    if (kMissing) {
        float own = valueAt(at);
        standIn(high, above, at, own);
        standIn(low, below, at, own);
    }
    return normalOf(high - low, above, below);
}

float bilinear(vec4 plane, vec2 t) {
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// Both at once. An interval to the side all weights are the same, so that what seven trilinear values
// read is read and weighted together: three lines of four values through the cell.
float valueAndNormal(vec3 at, out vec3 normal) {
    if (kMissing || kSampling != kTrilinear || kTexels == kTexture) {
        normal = normalAt(at);
        return valueAt(at);
    }
    ivec3 low = ivec3(at);
    vec3 t = at - vec3(low);
    ivec4 z = clamp(low.zzzz + ivec4(-1, 0, 1, 2), ivec4(0), lastPoint().zzzz);
    mat4 front = rowsAround(low.xy, z.y), back = rowsAround(low.xy, z.z);
    vec4 row0 = mix(front[0], back[0], t.z), row1 = mix(front[1], back[1], t.z);
    vec4 row2 = mix(front[2], back[2], t.z), row3 = mix(front[3], back[3], t.z);
    vec4 alongX = mix(row1, row2, t.y);
    vec4 alongY = mix(vec4(row0.y, row1.y, row2.y, row3.y), vec4(row0.z, row1.z, row2.z, row3.z), t.x);
    vec4 alongZ = vec4(bilinear(face(ivec3(low.xy, z.x)), t.xy),
                       bilinear(vec4(front[1].yz, front[2].yz), t.xy),
                       bilinear(vec4(back[1].yz, back[2].yz), t.xy),
                       bilinear(face(ivec3(low.xy, z.w)), t.xy));
    vec3 above = mix(vec3(alongX.z, alongY.z, alongZ.z), vec3(alongX.w, alongY.w, alongZ.w), t);
    vec3 below = mix(vec3(alongX.x, alongY.x, alongZ.x), vec3(alongX.y, alongY.y, alongZ.y), t);
    vec3 extent = min(at + 1.0, layer.grid.xyz - 1.0) - max(at - 1.0, vec3(0.0));
    normal = normalOf(extent, above, below);
    return mix(alongX.y, alongX.z, t.x);
}
