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
// kForesees: the model sees some samples first; kByDistance: passes over what empty_space.glsl knows; kSkipBricks, kEarlyStop, kMaxRaySamples;
// kInterval: only values in an interval count; kLit: levels are lit from the eye; kShaded: samples are by layer.light;
// those of lib/window.glsl and volume/voxels.glsl.
// Uses: classify through the model; segment through the model.
#include "lib/box.glsl"
#include "lib/jitter.glsl"
#include "lib/light.glsl"
#include "lib/window.glsl"
#include "volume/voxels.glsl"

const int kHalvings = 8;
const float kForeseen = 16.0;  // Grid intervals between samples that are looked at first.

// A ray in grid coordinates and its steps.
struct March {
    vec3 origin;
    vec3 direction;  // grid units per world unit
    float begin;     // world units from the ray's origin
    float extent;    // world units in the box
    float dt;        // world units a step
    int first;       // steps before it and from `steps` on are known to show nothing
    int steps;
    vec3 perGrid;    // world units that each axis takes for a grid interval; below 0: backwards
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
#include "volume/empty_space.glsl"

bool skipsRange(RayState state, vec2 range) {
    if (kInterval) range = vec2(max(range.x, layer.gather.z), min(range.y, layer.gather.w));
    return (kInterval && range.x > range.y) || skipsBetween(state, range.x, range.y);
}

// The value at a distance, and what the light adds to matter there.
float litValueAt(Ray ray, March march, float at, out vec2 light) {
    light = vec2(1.0, 0.0);
    if (!kShaded) return valueAt(positionAt(march, at));
    vec3 normal;
    float value = valueAndNormal(positionAt(march, at), normal);
    light = lightOn(normal, ray.origin + at * ray.direction, -ray.direction);
    return value;
}

#include "volume/pieces.glsl"

// Takes `count` steps from `i` on as one; `value` is that of the step before, then that of this one.
// True: nothing behind can show.
bool takeStep(inout RayState state, inout float value, Ray ray, March march, int i, int count) {
    float front = value;
    float extent = float(count) * march.dt;
    float at = distanceOf(march, float(i) + float(count) * (kPieces ? 1.0 : share));
    value = litValueAt(ray, march, at, pieceLight);
    if (kPieces && !kNarrows) {
        return takePiece(state, sampledPiece(front, value, extent, distanceOf(march, float(i))));
    }
    if (kInterval && (value < layer.gather.z || value > layer.gather.w)) return false;
    if (lacksValue(value)) return false;
    if (kPieces && lacksValue(front)) {
        enterData(state, sampledPiece(value, value, 0.0, at));
        return false;
    }
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

// Takes the steps from `i` to `beyond` or so, or until nothing behind can show. At least one is left.
bool takeSteps(inout RayState state, inout float value, Ray ray, March march, inout int i, int beyond) {
    bool finished = false;
    // Several a round where that is right: it saves most of what a round costs, and while one waits for
    // memory others are looked up.
    const int kAtOnce = kPieces || kShaded || kInterval || kMissing || kCoarseSteps || kSampling == kTricubic ? 1 : 4;
    if (kAtOnce > 1) {
        int last = march.steps - 1;
        do {
            // Behind the last step that one counts again, at no length.
            float values[kAtOnce];
            for (int k = 0; k < kAtOnce; ++k) values[k] = valueAfter(march, placeOf(min(i + k, last)));
            for (int k = 0; k < kAtOnce; ++k) {
                Segment piece = sampledPiece(values[k], values[k], i + k <= last ? march.dt : 0.0,
                                             distanceOf(march, float(i + k)));
                finished = stepRay(state, piece) && kEarlyStop;
            }
            i += kAtOnce;
        } while (i < beyond && !finished);
    } else {
        do {
            int count = stepsAsOne(march, i, beyond);
            finished = takeStep(state, value, ray, march, i, count);
            i += count;
        } while (i < beyond && !finished);
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

// Tells the model of some samples that are on its way, so that it need not visit most of the others.
void foresee(inout RayState state, March march, int together) {
    int apart = max(int(kForeseen * float(together) / (2.0 * float(kRangeReach))), 1);
    int i = min(apart, march.steps) / 2;
    do {
        float value = valueAfter(march, placeOf(i));
        Segment piece = sampledPiece(value, value, march.dt, distanceOf(march, float(i)));
        stepRay(state, piece);
        i += apart;
    } while (i < march.steps);
}

// Where the steps end that are to be passed over, or taken, together with step `i`.
int beyondAlike(RayState state, March march, int i, int together, bool skips, out bool shows) {
    if (!kByDistance) {
        shows = !skips || !skipsRange(state, rangeOfSteps(march, i, together));
        return i + together;
    }
    vec3 at = positionAt(march, distanceOf(march, placeOf(i)));
    // What ends on a wall, up to rounding, is looked at again. A sample needs its place alone, a piece
    // all of its step.
    float steps = emptyFrom(at, march.perGrid, shows) / march.dt - 1.0e-3;
    int whole = int(max(steps, 0.0)) + (kPieces ? 0 : 1);
    shows = shows || whole == 0;
    return i + (shows ? together : whole);
}

// The loops test at their ends: llvmpipe runs what lies behind a test once more for no lane at all.
RayState marched(Ray ray, March march) {
    RayState state = beginRay(ray);
    if (march.first >= march.steps) return state;
    if (kAdaptive) return marchedAdaptively(ray, march);
    if (kByVoxels) return marchedByVoxels(ray, march);
    float value = 0.0;
    bool finished = false;
    int together = stepsTogether(march);
    // Longer steps reach farther than ranges do.
    vec3 step = abs(march.direction) * march.dt;
    bool skips = max(step.x, max(step.y, step.z)) <= 2.0 * float(kRangeReach);
    if (kForesees && skips) foresee(state, march, together);
    int i = march.first;
    bool jumped = true;
    // Until it is known between which levels a ray is, ranges say nothing.
    bool entered = !kNarrows;
    do {
        int beyond = march.steps;
        int before = i;
        bool shows = true;
        if (kSkipBricks) {
            do {
                beyond = min(beyondAlike(state, march, i, together, skips && entered, shows), march.steps);
                i = shows ? i : beyond;
            } while (!shows && i < march.steps);
            jumped = jumped || i > before;
        }
        // No level lies in what was passed over.
        if (kPieces && jumped) {
            value = valueAfter(march, float(i));
            Segment here = sampledPiece(value, value, 0.0, distanceOf(march, float(i)));
            // But behind a gap the field may be anywhere.
            bool enters = !kNarrows || kMissing || !entered;
            if (enters && !lacksValue(value)) enterData(state, here);
            jumped = false;
        }
        if (shows) finished = takeSteps(state, value, ray, march, i, beyond);
        entered = entered || !lacksValue(value);
    } while (i < march.steps && !finished);
    if (kNarrows && finished) narrow(state, march, i - 1, value);
    return state;
}

// Leaves out the steps before and behind all blocks that show.
void cutToShown(inout March march) {
    vec2 span = boxSpan(march.origin, march.direction, shownCorner(0), shownCorner(3));
    vec2 steps = (span - march.begin) / march.dt;
    // One more at both ends, for rounding; spans may be empty, or end far away.
    march.first = int(clamp(floor(steps.x) - 1.0, 0.0, float(march.steps)));
    march.steps = int(clamp(ceil(steps.y) + 1.0, 0.0, float(march.steps)));
    if (!(span.x <= span.y)) march.first = march.steps;
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
    march.extent = end - march.begin;
    march.dt = march.extent / steps;
    march.first = 0;
    march.perGrid = 1.0 / mix(march.direction, vec3(1.0e-30), equal(march.direction, vec3(0.0)));
    if (kByDistance) cutToShown(march);
    RayState state = marched(ray, march);
    distance = hitDistance(state);
    float facing = 1.0;
    if (kLit && distance < kNoHit) {
        vec3 normal = normalAt(positionAt(march, distance));
        if (normal != vec3(0.0)) facing = abs(dot(normal, ray.direction));
    }
    return endRay(state, facing);
}
