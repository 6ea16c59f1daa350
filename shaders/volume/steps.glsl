// A ray in grid coordinates and its steps: equal ones over the exact length of the ray in the box, so
// that no step is partial and every ray's own length counts. Values sit on grid points; the box spans
// from the first to the last.
// Constants: kByDistance: rays pass over what volume/empty_space.glsl knows; kJitters: samples are not
// in the middle of their steps; kMaxRaySamples; those of lib/window.glsl.
#include "lib/box.glsl"
#include "lib/jitter.glsl"
#include "lib/window.glsl"
#include "volume/empty_space.glsl"

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

// Where samples are in their steps.
uint jitterSeed = uint(layer.jitter.x) | uint(layer.jitter.y) << 16u;
float share = kJitters ? shareOf(uvec2(gl_FragCoord.xy), jitterSeed) : 0.5;

float distanceOf(March march, float steps) {
    return march.begin + steps * march.dt;
}

vec3 positionAt(March march, float distance) {
    return march.origin + distance * march.direction;
}

// Leaves out the steps before and behind all blocks that show.
void cutToShown(inout March march) {
    // An axis that the ray does not advance on is so slow that its ends lie beyond all others, or
    // both to one side.
    vec3 low = (layer.shownLow.xyz - march.origin) * march.perGrid;
    vec3 high = (layer.shownHigh.xyz - march.origin) * march.perGrid;
    vec3 front = min(low, high), back = max(low, high);
    vec2 span = vec2(max(front.x, max(front.y, front.z)), min(back.x, min(back.y, back.z)));
    vec2 steps = (span - march.begin) / march.dt;
    // One more at both ends, for rounding; spans may be empty, or end far away.
    march.first = int(clamp(floor(steps.x) - 1.0, 0.0, float(march.steps)));
    march.steps = int(clamp(ceil(steps.y) + 1.0, 0.0, float(march.steps)));
    bool none = any(greaterThan(layer.shownLow.xyz, layer.shownHigh.xyz));
    if (none || !(span.x <= span.y)) march.first = march.steps;
}

// The steps of a ray in the box and in `window`. False: the ray does not meet it, there are none.
bool meetsBox(Ray ray, Window window, out March march) {
    march.origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    march.direction = mat3(layer.gridFromData) * ray.direction;
    vec2 span = boxSpan(march.origin, march.direction, vec3(0.0), layer.grid.xyz - 1.0);
    march.begin = max(span.x, window.begin);
    float end = min(span.y, window.end);
    bool meets = march.begin <= end;
    float steps = clamp(ceil((end - march.begin) / layer.grid.w), 1.0, float(kMaxRaySamples));
    march.steps = meets ? int(steps) : 0;
    march.extent = end - march.begin;
    march.dt = march.extent / steps;
    march.first = 0;
    march.perGrid = 1.0 / mix(march.direction, vec3(1.0e-30), equal(march.direction, vec3(0.0)));
    if (kByDistance && meets) cutToShown(march);
    return meets;
}

// Steps that are taken or looked at together: no more than lie within kRangeReach of their middle, and
// at least one. Equal for all steps of a ray and nearly so for all rays, so that they stay side by side.
int stepsTogether(March march) {
    vec3 step = abs(march.direction) * march.dt;
    return int(clamp(2.0 * float(kRangeReach) / max(step.x, max(step.y, step.z)), 1.0, 4096.0));
}

// How many steps from a place on, given in steps, show nothing; 0: it may show. What ends on a wall, up
// to rounding, is looked at again. `samples`: a step is its sample alone, which is there; else all of it.
int emptySteps(March march, float place, bool samples) {
    vec3 at = positionAt(march, distanceOf(march, place));
    bool shows;
    float steps = emptyFrom(at, march.perGrid, shows) / march.dt - 1.0e-3;
    int whole = int(max(steps, 0.0)) + (samples ? 1 : 0);
    return shows ? 0 : whole;
}
