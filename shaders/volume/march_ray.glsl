// Marches through a voxel volume: equal steps over the exact length of the ray in the box, so that
// no step is partial and every ray's own length counts. Values sit on grid points; the box spans
// from the first to the last.
//
// A step's piece is constant, of the value in its middle; where kPieces it runs from the value at
// its front end to that at its back. A piece that ends the ray is then halved kHalvings times, so
// that the hit is less than dt / 2^kHalvings from a point where the field has the level's value: it
// is on different sides at both ends of what is left. A line through these ends gives the hit. A
// field that crosses a level and comes back within one step is not seen to do so.
// Constants: kPieces, kSkipBricks, kEarlyStop, kMaxRaySamples, kBrickSize, kTricubicOvershoot;
// kInterval: only values in an interval count; kLit: levels are lit from the eye; kShaded: samples are by layer.light;
// those of lib/window.glsl and volume/voxels.glsl.
// Uses: classify through the model; segment through the model.
#include "lib/box.glsl"
#include "lib/light.glsl"
#include "lib/window.glsl"
#include "volume/voxels.glsl"

layout(binding = kBrickUnit) uniform sampler3D brickRanges;  // r: smallest, g: largest value

const int kHalvings = 8;

// A ray in grid coordinates and its steps.
struct March {
    vec3 origin;
    vec3 direction;  // grid units per world unit
    float begin;     // world units from the ray's origin
    float dt;        // world units a step
    int steps;
};

float distanceOf(March march, float steps) {
    return march.begin + steps * march.dt;
}

vec3 positionAt(March march, float distance) {
    return march.origin + distance * march.direction;
}

// The value after so many steps.
float valueAfter(March march, float steps) {
    return valueAt(positionAt(march, distanceOf(march, steps)));
}

Segment sampledPiece(float front, float back, float extent, float distance) {
    return Segment(front, back, front, back, extent, distance);
}

// Where step `i` belongs: its front end or its middle.
float placeOf(int i) {
    return kPieces ? float(i) : float(i) + 0.5;
}

ivec3 lastBrick() {
    return max((ivec3(layer.grid.xyz) - 2) / kBrickSize, ivec3(0));
}

vec2 rangeOf(ivec3 brick) {
    return texelFetch(brickRanges, clamp(brick, ivec3(0), lastBrick()), 0).rg;
}

vec2 rangeOf(vec2 a, vec2 b, vec2 c) {
    return vec2(min(a.x, min(b.x, c.x)), max(a.y, max(b.y, c.y)));
}

vec2 rowRange(ivec3 brick) {
    ivec3 next = ivec3(1, 0, 0);
    return rangeOf(rangeOf(brick - next), rangeOf(brick), rangeOf(brick + next));
}

vec2 planeRange(ivec3 brick) {
    ivec3 next = ivec3(0, 1, 0);
    return rangeOf(rowRange(brick - next), rowRange(brick), rowRange(brick + next));
}

// What tricubic values in a brick are within. They are sums over voxels that reach into the bricks
// around. Along an axis the weights below 0 add up to -t (1 - t) / 2, so that all their sizes do to
// 1 + t (1 - t) <= 5/4; along three to 125/64. All weights add up to 1: those below 0 to -N and
// those above to 1 + N with 1 + 2 N <= 125/64, N <= 61/128. Values are then between
// low - N (high - low) and high + N (high - low); kTricubicOvershoot, 0.48, is more than N by more
// than all rounding.
vec2 tricubicRange(ivec3 brick) {
    ivec3 next = ivec3(0, 0, 1);
    vec2 range = rangeOf(planeRange(brick - next), planeRange(brick), planeRange(brick + next));
    float overshoot = kTricubicOvershoot * (range.y - range.x);
    return range + vec2(-overshoot, overshoot);
}

// The brick of step `i`: its range, and the first step beyond it.
vec2 brickAt(March march, int i, out int beyond) {
    vec3 position = positionAt(march, distanceOf(march, placeOf(i)));
    ivec3 brick = clamp(ivec3(floor(position)) / kBrickSize, ivec3(0), lastBrick());
    vec3 ahead = vec3(greaterThan(march.direction, vec3(0.0)));
    vec3 wall = (vec3(brick) + ahead) * float(kBrickSize) - march.origin;
    vec3 way = mix(wall / march.direction, vec3(3.0e38), equal(march.direction, vec3(0.0)));
    float leave = min(way.x, min(way.y, way.z));
    float index = (leave - march.begin) / march.dt - placeOf(0);
    beyond = min(max(int(min(index, float(march.steps))) + 1, i + 1), march.steps);
    return kSampling == kTricubic ? tricubicRange(brick) : rangeOf(brick);
}

bool skipsRange(RayState state, vec2 range) {
    if (kInterval) range = vec2(max(range.x, layer.gather.z), min(range.y, layer.gather.w));
    return (kInterval && range.x > range.y) || skipsBetween(state, range.x, range.y);
}

// Takes step `i`; `value` is that of the step before, then that of this one. True: nothing behind
// can show.
bool takeStep(inout RayState state, inout float value, Ray ray, March march, int i) {
    float front = value;
    float at = distanceOf(march, kPieces ? float(i + 1) : placeOf(i));
    value = valueAt(positionAt(march, at));
    if (kInterval && (value < layer.gather.z || value > layer.gather.w)) return false;
    if (kShaded && matterAt(value, value).a > 0.0) {
        pieceLight = lightOn(normalAt(positionAt(march, at)), ray.origin + at * ray.direction,
                             -ray.direction);
    }
    Segment piece = sampledPiece(kPieces ? front : value, value, march.dt, distanceOf(march, float(i)));
    return stepRay(state, piece) && kEarlyStop;
}

// Narrows step `i`, which ended the ray; its back value is `back`.
void narrow(inout RayState state, March march, int i, float back) {
    float distance = distanceOf(march, float(i));
    float front = valueAfter(march, float(i));
    float extent = march.dt;
    for (int halving = 0; halving < kHalvings; ++halving) {
        extent *= 0.5;
        float middle = valueAt(positionAt(march, distance + extent));
        Segment nearer = sampledPiece(front, middle, extent, distance);
        enterData(state, nearer);
        bool met = stepRay(state, nearer);
        back = met ? middle : back;
        front = met ? front : middle;
        distance += met ? 0.0 : extent;
    }
    Segment last = sampledPiece(front, back, extent, distance);
    enterData(state, last);
    stepRay(state, last);
}

RayState marched(Ray ray, March march) {
    RayState state = beginRay(ray);
    float value = kPieces ? valueAfter(march, 0.0) : 0.0;
    if (kPieces) enterData(state, sampledPiece(value, value, 0.0, march.begin));
    bool finished = false;
    int i = 0;
    if (!kSkipBricks) {
        for (; i < march.steps && !finished; ++i) finished = takeStep(state, value, ray, march, i);
    }
    while (i < march.steps && !finished) {
        int beyond;
        vec2 range = brickAt(march, i, beyond);
        if (skipsRange(state, range)) {
            // The piece that leaves the brick ends beyond it.
            i = kPieces ? beyond - 1 : beyond;
            if (kPieces) value = valueAfter(march, float(i));
        }
        for (; i < beyond && !finished; ++i) finished = takeStep(state, value, ray, march, i);
    }
    if (kPieces && finished) narrow(state, march, i - 1, value);
    return state;
}

// What the ray of a pixel gathers, and how far away it was ended by something opaque.
vec4 castRay(vec2 pixel, out float distance) {
    Ray ray = rayThrough(pixel);
    Window window = windowOf(ray, pixel);
    March march;
    march.origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    march.direction = mat3(layer.gridFromData) * ray.direction;
    vec2 span = boxSpan(march.origin, march.direction, vec3(0.0), layer.grid.xyz - 1.0);
    march.begin = max(span.x, window.begin);
    float end = min(span.y, window.end);
    distance = kNoHit;
    if (!(march.begin <= end)) return endRay(beginRay(ray), 1.0);
    float steps = clamp(ceil((end - march.begin) / layer.grid.w), 1.0, float(kMaxRaySamples));
    march.steps = int(steps);
    march.dt = (end - march.begin) / steps;
    RayState state = marched(ray, march);
    distance = hitDistance(state);
    float facing = 1.0;
    if (kLit && distance < kNoHit) {
        vec3 normal = normalAt(positionAt(march, distance));
        if (normal != vec3(0.0)) facing = abs(dot(normal, ray.direction));
    }
    return endRay(state, facing);
}
