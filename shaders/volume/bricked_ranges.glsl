// What the values near a point are within, of a channel whose voxels are bricks of a pool: the same
// function as in volume/ranges.glsl.
// Constants: kRangeReach; those of volume/bricked_voxels.glsl.
#include "volume/bricked_voxels.glsl"

// The range of all values within kRangeReach of a point in the box, along each axis. That is at most a
// brick's extent, so that bricks which hold none of the corners hold nothing of it. Ranges of bricks
// are those of tricubic values where these are asked for.
vec2 rangeAround(vec3 at) {
    vec3 low = max(at - float(kRangeReach), vec3(0.0));
    vec3 high = min(at + float(kRangeReach), vec3(gridLast));
    turnTo(clamp(at, vec3(0.0), vec3(gridLast)));
    vec2 range = page.range;
    if (all(greaterThanEqual(low, page.low)) && all(lessThanEqual(high, page.high))) return range;
    for (int corner = 0; corner < 8; ++corner) {
        vec2 other = pageAt(mix(low, high, vec3(corner & 1, corner >> 1 & 1, corner >> 2))).range;
        range = vec2(min(range.x, other.x), max(range.y, other.y));
    }
    return range;
}
