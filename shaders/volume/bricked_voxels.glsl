// The field of a channel between its grid points, from bricks of several levels of its pyramid: the
// same functions as volume/voxels.glsl, for volumes that are not on the GPU as a whole.
//
// Positions are grid coordinates of level 0. Point j of level k lies at min(2^k j, last), so that
// only the last interval of a level may be shorter. A tree tells which brick serves a place; where
// what is asked for has not been loaded, a coarser one does. Neighbours of different levels differ
// on the face between them as much as the levels do there.
// Constants: kSampling; kCoarserLevels: levels of the pyramid above level 0; kVoxelKind: how the
// bits of a voxel are a number.
#include "lib/layer.glsl"
#include "lib/unit.glsl"
#include "shared/brick_pool.glsl"
#include "volume/missing.glsl"

layout(binding = kVoxelUnit) uniform usampler3D brickVoxels;
layout(binding = kBrickUnit) uniform isamplerBuffer brickTree;

const int kNearest = 0;
const int kTrilinear = 1;
const int kTricubic = 2;

// A part of the volume that one brick serves.
struct Page {
    vec3 low;      // where it is
    vec3 high;
    vec2 range;    // smallest and largest value that it may yield
    int level;     // of the brick
    ivec3 first;   // the brick's first grid point, at its level
    ivec3 texels;  // where the level's grid point 0 would be in the texture
    float shift;   // taken off all voxels
    // Of its level, for each axis: the last grid point and the one before it, where the last interval
    // begins; 1 / the interval before that point and behind it, in intervals of level 0.
    vec3 last;
    vec3 before;
    float perInterval;
    vec3 perLastInterval;
};

// The one of the last value asked for: most samples are followed by one in the same.
Page page = Page(vec3(1.0), vec3(0.0), vec2(0.0), 0, ivec3(0), ivec3(0), 0.0,
                 vec3(0.0), vec3(0.0), 1.0, vec3(1.0));

// Computed before any loop, because llvmpipe reads a uniform again in each round: see
// classify/transfer_function.glsl.
ivec3 gridLast = ivec3(layer.grid.xyz + max(-gl_FragCoord.x, 0.0)) - 1;
mat3 worldFromSlope = transpose(mat3(layer.gridFromData)) + max(-gl_FragCoord.x, 0.0);
float voxelShift = intBitsToFloat(texelFetch(brickTree, kTreeHead).x);

ivec3 lastPoint(int level) {
    return (gridLast + (1 << level) - 1) >> level;
}

ivec3 lastPoint() {
    return gridLast;
}

Page pageAt(vec3 at) {
    Page found;
    ivec3 finest = min(ivec3(at) / kPoolBrick, max((lastPoint(0) - 1) / kPoolBrick, ivec3(0)));
    int node = kRootNode;
    found.shift = voxelShift;
    for (int level = kCoarserLevels; level >= 0; --level) {
        ivec4 entry = texelFetch(brickTree, node);
        ivec3 place = finest >> level;
        if (entry.y != kNotLoaded) found.range = intBitsToFloat(entry.zw);
        if (entry.y >= 0) {
            int mask = (1 << kSlotBits) - 1;
            ivec3 slot = ivec3(entry.y, entry.y >> kSlotBits, entry.y >> 2 * kSlotBits) & mask;
            found.level = level;
            found.first = place * kPoolBrick;
            found.texels = slot * (kPoolBrick + 1 + 2 * kBrickBorder) + kBrickBorder - found.first;
        }
        float side = float(kPoolBrick << level);
        found.low = vec3(place) * side;
        found.high = found.low + side;
        if (entry.x == 0) break;
        ivec3 child = (finest >> (level - 1)) & 1;
        node = entry.x + child.x + 2 * child.y + 4 * child.z;
    }
    float interval = float(1 << found.level);
    found.last = vec3(lastPoint(found.level));
    found.before = max(found.last - 1.0, vec3(0.0));
    found.perInterval = 1.0 / interval;
    found.perLastInterval = 1.0 / max(vec3(gridLast) - interval * found.before, vec3(1.0));
    return found;
}

void turnTo(vec3 at) {
    if (any(lessThan(at, page.low)) || any(greaterThan(at, page.high))) page = pageAt(at);
}

// A place at grid coordinates of the page's level, and back.
vec3 levelFromGrid(vec3 at) {
    return min(at * page.perInterval, page.before) +
           max(at - page.before / page.perInterval, vec3(0.0)) * page.perLastInterval;
}

vec3 gridFromLevel(vec3 at) {
    return min(at, page.before) / page.perInterval +
           max(at - page.before, vec3(0.0)) / page.perLastInterval;
}

float voxel(ivec3 texel) {
    uint bits = texelFetch(brickVoxels, texel, 0).r;
    if (kVoxelKind == kFloatVoxels) return uintBitsToFloat(bits) - page.shift;
    return (kVoxelKind == kSignedVoxels ? float(int(bits << 16) >> 16) : float(bits)) - page.shift;
}

float trilinear(ivec3 low, vec3 t) {
    ivec3 high = low + 1;
    vec4 front = vec4(voxel(low), voxel(ivec3(high.x, low.yz)), voxel(ivec3(low.x, high.y, low.z)),
                      voxel(ivec3(high.xy, low.z)));
    vec4 back = vec4(voxel(ivec3(low.xy, high.z)), voxel(ivec3(high.x, low.y, high.z)),
                     voxel(ivec3(low.x, high.yz)), voxel(high));
    vec4 plane = mix(front, back, t.z);
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// As in volume/voxels.glsl, where their source is told.
vec4 cubicWeights(float t) {
    return 0.5 * vec4(((2.0 - t) * t - 1.0) * t, (3.0 * t - 5.0) * t * t + 2.0,
                      ((4.0 - 3.0 * t) * t + 1.0) * t, (t - 1.0) * t * t);
}

float cubicLine(ivec3 low, vec4 x, int y, int z) {
    ivec3 row = low + ivec3(-1, y, z);
    return dot(x, vec4(voxel(row), voxel(row + ivec3(1, 0, 0)), voxel(row + ivec3(2, 0, 0)),
                       voxel(row + ivec3(3, 0, 0))));
}

float cubicPlane(ivec3 low, vec4 x, vec4 y, int z) {
    return dot(y, vec4(cubicLine(low, x, -1, z), cubicLine(low, x, 0, z), cubicLine(low, x, 1, z),
                       cubicLine(low, x, 2, z)));
}

// Written out: loops would soon meet the limit of llvmpipe.
float tricubic(ivec3 low, vec3 t) {
    vec4 x = cubicWeights(t.x), y = cubicWeights(t.y);
    return dot(cubicWeights(t.z), vec4(cubicPlane(low, x, y, -1), cubicPlane(low, x, y, 0),
                                       cubicPlane(low, x, y, 1), cubicPlane(low, x, y, 2)));
}

// The value at grid coordinates `at` of the page's level, at most one grid interval outside of its
// brick: a border of kBrickBorder points serves all that is read.
float valueInPage(vec3 at, int sampling) {
    ivec3 last = ivec3(page.last);
    if (sampling == kNearest) {
        return voxel(page.texels + clamp(ivec3(floor(at + 0.5)), ivec3(0), last));
    }
    // The same cell as if there was no page: on a face of a brick both give one value.
    ivec3 low = clamp(ivec3(floor(at)), ivec3(0), max(last - 1, ivec3(0)));
    low = clamp(low, page.first - 1, page.first + kPoolBrick);
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    return sampling == kTricubic ? tricubic(page.texels + low, t)
                                  : trilinear(page.texels + low, t);
}

float valueInPage(vec3 at) {
    return valueInPage(at, kSampling);
}

// The value at grid coordinates `at`. Where a coarser brick stands in for one that was left out for
// what is in it, values stay within that.
float valueAt(vec3 at) {
    at = clamp(at, vec3(0.0), vec3(gridLast));
    turnTo(at);
    if (kMissing && page.range.x > page.range.y) return noValue();
    float value = valueInPage(levelFromGrid(at));
    return lacksValue(value) ? value : clamp(value, page.range.x, page.range.y);
}

// The shortest side of a voxel of level 0, in the world: rows of the matrix are as long as 1 / a side.
float voxelSide() {
    mat3 world = transpose(mat3(layer.gridFromData));
    return 1.0 / max(length(world[0]), max(length(world[1]), length(world[2])));
}

// How many of the layer's steps a sample stands for on level 0, at most 1: less where the step is
// longer than half the shortest side of a voxel.
float coarserSteps = min(0.5 * voxelSide() / layer.grid.w, 1.0);

// Steps of a ray that a sample stands for, from `at` on: as many more as the brick's voxels are longer,
// as long as all of them lie in the brick.
int stepsASample(vec3 at, vec3 step) {
    turnTo(clamp(at, vec3(0.0), vec3(gridLast)));
    int count = max(int(coarserSteps * float(1 << page.level)), 1);
    vec3 end = at + float(count) * step;
    bool within = all(greaterThanEqual(end, page.low)) && all(lessThanEqual(end, page.high));
    return within ? count : 1;
}

// The direction in which the field rises most, of length 1 in the world; 0 where it is flat. By
// central differences over a grid interval of the level to each side; at a face of the box one side
// is shorter.
vec3 normalAt(vec3 at) {
    at = clamp(at, vec3(0.0), vec3(gridLast));
    turnTo(at);
    vec3 middle = levelFromGrid(at);
    vec3 low = max(middle - 1.0, vec3(0.0));
    vec3 high = min(middle + 1.0, page.last);
    vec3 above = vec3(valueInPage(vec3(high.x, middle.yz)),
                      valueInPage(vec3(middle.x, high.y, middle.z)),
                      valueInPage(vec3(middle.xy, high.z)));
    vec3 below = vec3(valueInPage(vec3(low.x, middle.yz)),
                      valueInPage(vec3(middle.x, low.y, middle.z)),
                      valueInPage(vec3(middle.xy, low.z)));
    if (kMissing) {
        float own = valueInPage(middle);
        standIn(high, above, middle, own);
        standIn(low, below, middle, own);
    }
    vec3 extent = gridFromLevel(high) - gridFromLevel(low);
    // Quarters, because the difference of two large values may not be a number.
    vec3 slope = (0.25 * above - 0.25 * below) / max(extent, vec3(0.5));
    return unit(worldFromSlope * scaledToOne(slope));
}

float valueAndNormal(vec3 at, out vec3 normal) {
    normal = normalAt(at);
    return valueAt(at);
}
