// Marches through a voxel volume: equal steps over the exact length of the ray in the box, so that
// no step is partial and every ray's own length counts. Values sit on grid points; the box spans
// from the first to the last.
//
// A step's piece is constant, of the value in its middle; where kPieces it runs from the value at
// its front end to that at its back (volume/pieces.glsl). Where kNarrows a piece that ends the ray is
// then halved kHalvings times, so that the hit is less than dt / 2^kHalvings from a point where the
// field has the level's value: it is on different sides at both ends of what is left. A line through
// these ends gives the hit. A field that crosses a level and comes back within one step is not seen to
// do so. Where kAdaptive steps are no longer equal, where kByVoxels pieces are those of voxels.
// kCoarseSteps: coarser voxels have longer steps.
// Constants: kPieces, kNarrows, kAdaptive, kByVoxels, kCoarseSteps; kJitters: samples are not in the middle;
// kForesees: the model is told all ranges first; kSkipBricks, kEarlyStop, kMaxRaySamples;
// kInterval: only values in an interval count; kLit: levels are lit from the eye; kShaded: samples are by layer.light;
// those of lib/window.glsl and volume/voxels.glsl.
// Uses: classify through the model; segment through the model.
#include "lib/box.glsl"
#include "lib/jitter.glsl"
#include "lib/light.glsl"
#include "lib/window.glsl"
#include "volume/voxels.glsl"

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

// Where the samples of a ray are in their steps.
uint jitterSeed = uint(layer.jitter.x) | uint(layer.jitter.y) << 16u;
float share = kJitters ? shareOf(uvec2(gl_FragCoord.xy), jitterSeed) : 0.5;

// Where step `i` belongs: its front end or its sample.
float placeOf(int i) {
    return kPieces ? float(i) : float(i) + share;
}

// Steps from `i` on that are taken as one; coarse voxels need fewer samples.
int stepsAsOne(March march, int i, int beyond) {
    if (!kCoarseSteps) return 1;
    vec3 at = positionAt(march, distanceOf(march, float(i)));
    return min(stepsASample(at, march.dt * march.direction), beyond - i);
}

#include "volume/ranges.glsl"

bool skipsRange(RayState state, vec2 range) {
    if (kInterval) range = vec2(max(range.x, layer.gather.z), min(range.y, layer.gather.w));
    return (kInterval && range.x > range.y) || skipsBetween(state, range.x, range.y);
}

// What the light adds to matter at a distance; where there is none it is not looked for.
vec2 lightAt(Ray ray, March march, float at, vec4 matter) {
    if (!kShaded || matter.a <= 0.0) return vec2(1.0, 0.0);
    return lightOn(normalAt(positionAt(march, at)), ray.origin + at * ray.direction, -ray.direction);
}

#include "volume/pieces.glsl"

// Takes `count` steps from `i` on as one; `value` is that of the step before, then that of this one.
// True: nothing behind can show.
bool takeStep(inout RayState state, inout float value, Ray ray, March march, int i, int count) {
    float front = value;
    float extent = float(count) * march.dt;
    float at = distanceOf(march, float(i) + float(count) * (kPieces ? 1.0 : share));
    value = valueAt(positionAt(march, at));
    if (kPieces && !kNarrows) {
        return takePiece(state, sampledPiece(front, value, extent, distanceOf(march, float(i))));
    }
    if (kInterval && (value < layer.gather.z || value > layer.gather.w)) return false;
    if (lacksValue(value)) return false;
    if (kPieces && lacksValue(front)) {
        enterData(state, sampledPiece(value, value, 0.0, at));
        return false;
    }
    if (kShaded) pieceLight = lightAt(ray, march, at, matterAt(value, value));
    Segment piece = sampledPiece(kPieces ? front : value, value, extent, distanceOf(march, float(i)));
    return stepRay(state, piece) && kEarlyStop;
}

// Narrows step `i`, which ended the ray; its back value is `back`.
void narrow(inout RayState state, March march, int i, float back) {
    float distance = distanceOf(march, float(i));
    float front = valueAfter(march, float(i));
    float extent = march.dt;
    for (int halving = 0; halving < kHalvings; ++halving) {
        float middle = valueAt(positionAt(march, distance + 0.5 * extent));
        if (lacksValue(middle)) break;
        extent *= 0.5;
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

// Takes the steps from `i` up to `beyond`, or until nothing behind can show.
bool takeSteps(inout RayState state, inout float value, Ray ray, March march, inout int i, int beyond) {
    bool finished = false;
    // Two a round where that is right: it halves what a round costs, and one waits for memory while
    // the other is looked up.
    const bool kTwo = !kPieces && !kShaded && !kInterval && kSampling != kTricubic && !kMissing && !kCoarseSteps;
    for (; kTwo && i + 1 < beyond && !finished; i += 2) {
        float first = valueAfter(march, placeOf(i));
        value = valueAfter(march, placeOf(i + 1));
        Segment piece = sampledPiece(first, first, march.dt, distanceOf(march, float(i)));
        stepRay(state, piece);
        piece = sampledPiece(value, value, march.dt, distanceOf(march, float(i + 1)));
        finished = stepRay(state, piece) && kEarlyStop;
    }
    while (i < beyond && !finished) {
        int count = stepsAsOne(march, i, beyond);
        finished = takeStep(state, value, ray, march, i, count);
        i += count;
    }
    return finished;
}

#include "volume/march_adaptive.glsl"
#include "volume/march_voxels.glsl"

// Steps that are looked at together: no more than lie within kRangeReach of their middle, and at
// least one. Equal for all steps of a ray and nearly so for all rays, so that they stay side by side.
int stepsTogether(March march) {
    vec3 step = abs(march.direction) * march.dt;
    return int(clamp(2.0 * float(kRangeReach) / max(step.x, max(step.y, step.z)), 1.0, 4096.0));
}

// The range of all values on steps [first, first + count].
vec2 rangeOfSteps(March march, int first, int count) {
    return rangeAround(positionAt(march, distanceOf(march, float(first) + 0.5 * float(count))));
}

// Tells the model what is on its way, so that it need not visit most of it.
void foreseeAll(inout RayState state, March march, int together) {
    for (int i = 0; i + together <= march.steps; i += together) {
        vec2 range = rangeOfSteps(march, i, together);
        foresee(state, range.x, range.y);
    }
}

RayState marched(Ray ray, March march) {
    if (kAdaptive) return marchedAdaptively(ray, march);
    if (kByVoxels) return marchedByVoxels(ray, march);
    RayState state = beginRay(ray);
    float value = kPieces ? valueAfter(march, 0.0) : 0.0;
    if (kPieces && !lacksValue(value)) {
        enterData(state, sampledPiece(value, value, 0.0, march.begin));
    }
    bool finished = false;
    int i = 0;
    if (!kSkipBricks) finished = takeSteps(state, value, ray, march, i, march.steps);
    int together = stepsTogether(march);
    // Longer steps reach farther than ranges do.
    vec3 step = abs(march.direction) * march.dt;
    bool skips = max(step.x, max(step.y, step.z)) <= 2.0 * float(kRangeReach);
    if (kForesees && skips) foreseeAll(state, march, together);
    while (kSkipBricks && i < march.steps && !finished) {
        int beyond = min(i + together, march.steps);
        if (skips && skipsRange(state, rangeOfSteps(march, i, together))) {
            i = beyond;
            if (kPieces) value = valueAfter(march, float(i));
            // Behind a gap the field may be anywhere.
            if (kPieces && (!kNarrows || kMissing) && !lacksValue(value)) {
                enterData(state, sampledPiece(value, value, 0.0, distanceOf(march, float(i))));
            }
        } else {
            finished = takeSteps(state, value, ray, march, i, beyond);
        }
    }
    if (kNarrows && finished) narrow(state, march, i - 1, value);
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
