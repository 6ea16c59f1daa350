// Marches through a voxel volume, by the steps of volume/steps.glsl.
//
// A step's piece is constant, of the value in its middle; where kPieces it runs from the value at
// its front end to that at its back (volume/pieces.glsl). Where kNarrows a piece that ends the ray is
// then halved kHalvings times, so that the hit is less than dt / 2^kHalvings from a point where the
// field has the level's value: it is on different sides at both ends of what is left. A line through
// these ends gives the hit. A field that crosses a level and comes back within one step is not seen to
// do so. Where kAdaptive steps are no longer equal, where kByVoxels pieces are those of voxels.
// kCoarseSteps: coarser voxels have longer steps.
// Constants: kPieces, kNarrows, kAdaptive, kByVoxels, kCoarseSteps; kForesees: the model sees some samples
// first; kSkipBricks, kEarlyStop; kInterval: only values in an interval count; kLit: levels are lit from the
// eye; kShaded: samples are by layer.light; those of volume/steps.glsl and volume/voxels.glsl.
// Uses: classify through the model; segment through the model.
#include "lib/light.glsl"
#include "volume/steps.glsl"
#include "volume/voxels.glsl"

const int kHalvings = 8;
const float kForeseen = 16.0;  // Grid intervals between samples that are looked at first.

// The value after so many steps.
float valueAfter(March march, float steps) {
    return valueAt(positionAt(march, distanceOf(march, steps)));
}

Segment sampledPiece(float front, float back, float extent, float distance) {
    return Segment(front, back, front, back, extent, distance);
}

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

Segment lastPiece = Segment(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);  // that a ray took; where kNarrows

// Cuts a piece with one end where there is no value to the cell of its other end, all of which has values:
// a level may be crossed between a gap and the step beside it. False: nothing of it has values that vary.
bool cutToCell(inout Segment piece, March march) {
    bool noFront = lacksValue(piece.front), noBack = lacksValue(piece.back);
    if (noFront == noBack) return !noFront;
    if (kSampling == kNearest) return false;
    vec3 at = positionAt(march, piece.distance + (noFront ? piece.extent : 0.0));
    vec3 towards = noFront ? -march.direction : march.direction;
    vec3 wall = floor(at) + mix(vec3(0.0), vec3(1.0), greaterThan(towards, vec3(0.0)));
    vec3 way = abs((wall - at) * march.perGrid);
    // Short of the wall by less than what hits are off by: on it rounding would choose the cell.
    float extent = min(0.999 * min(way.x, min(way.y, way.z)), piece.extent);
    float place = piece.distance + (noFront ? piece.extent - extent : extent);
    float value = valueAt(positionAt(march, place));
    if (noFront) piece.distance = place;
    if (noFront) piece.front = value;
    if (noBack) piece.back = value;
    piece.extent = extent;
    return !lacksValue(value);
}

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
    if (!kPieces && lacksValue(value)) return false;
    Segment piece = sampledPiece(kPieces ? front : value, value, extent, distanceOf(march, float(i)));
    if (kNarrows && kMissing) {
        bool there = cutToCell(piece, march);
        if (!there) piece.front = value;
        if (lacksValue(front) && !lacksValue(value)) enterData(state, piece);
        if (!there) return false;
    }
    lastPiece = piece;
    return stepRay(state, piece) && kEarlyStop;
}

// Narrows the piece that ended the ray.
void narrow(inout RayState state, March march) {
    float distance = lastPiece.distance, extent = lastPiece.extent;
    float front = lastPiece.front, back = lastPiece.back;
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

// Whether a sample is there, in the interval, and has matter.
bool isSeen(float value) {
    bool counts = !kInterval || (value >= layer.gather.z && value <= layer.gather.w);
    return counts && !lacksValue(value) && matterAt(value, value).a > 0.0;
}

// Under a light, of a map that is transparent in parts: takes the steps from `i` to `beyond`. Slopes are
// dear, and llvmpipe finds them for all rays that run side by side if it does for one: each of these first
// goes on to its next sample that is seen.
bool takeLitSteps(inout RayState state, Ray ray, March march, inout int i, int beyond) {
    bool finished = false;
    do {
        int count = 1;
        float at = 0.0, value = 0.0;
        bool seen = false;
        do {
            count = stepsAsOne(march, i, beyond);
            at = distanceOf(march, float(i) + float(count) * share);
            value = valueAt(positionAt(march, at));
            seen = isSeen(value);
            i += seen ? 0 : count;
        } while (!seen && i < beyond);
        if (seen) {
            vec3 normal = normalAt(positionAt(march, at));
            pieceLight = lightOn(normal, ray.origin + at * ray.direction, -ray.direction);
            Segment piece = sampledPiece(value, value, float(count) * march.dt, distanceOf(march, float(i)));
            finished = stepRay(state, piece) && kEarlyStop;
            i += count;
        }
    } while (i < beyond && !finished);
    return finished;
}

// Takes the steps from `i` to `beyond` or so, or until nothing behind can show. At least one is left.
bool takeSteps(inout RayState state, inout float value, Ray ray, March march, inout int i, int beyond) {
    if (kShaded && kSkipBricks && !kPieces) return takeLitSteps(state, ray, march, i, beyond);
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
    // A sample needs its place alone, a piece all of its step.
    int empty = emptySteps(march, placeOf(i), !kPieces);
    shows = empty == 0;
    return i + (shows ? together : empty);
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
    if (kNarrows && finished) narrow(state, march);
    return state;
}

// What the ray of a pixel gathers, and how far away it was ended by something opaque.
vec4 castRay(vec2 pixel, out float distance) {
    Ray ray = rayThrough(pixel);
    March march;
    distance = kNoHit;
    if (!meetsBox(ray, windowOf(ray, pixel), march)) return endRay(beginRay(ray), 1.0);
    RayState state = marched(ray, march);
    distance = hitDistance(state);
    float facing = 1.0;
    if (kLit && distance < kNoHit) {
        vec3 normal = normalAt(positionAt(march, distance));
        if (normal != vec3(0.0)) facing = abs(dot(normal, ray.direction));
    }
    return endRay(state, facing);
}
