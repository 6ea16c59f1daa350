// Marches through a voxel volume: equal steps over the exact length of the ray in the box, one
// sample in the middle of each, so that no step is partial and every ray's own length counts.
// Values sit on grid points; the box spans from the first to the last.
// Constants: kTrilinear, kSkipBricks, kEarlyStop, kMaxRaySamples, kBrickSize, kFilterInHardware.
// Uses: classify through the model; segment through the model.
#include "lib/layer.glsl"
#include "lib/box.glsl"

layout(binding = kVoxelUnit) uniform sampler3D voxels;
layout(binding = kBrickUnit) uniform sampler3D brickRanges;  // r: smallest, g: largest value

layout(location = 0) out vec4 colour;

float voxel(ivec3 point) {
    return texelFetch(voxels, point, 0).r;
}

// The value at grid coordinates `at`, trilinear or that of the nearest grid point.
float valueAt(vec3 at) {
    ivec3 last = ivec3(layer.grid.xyz) - 1;
    if (!kTrilinear) return voxel(clamp(ivec3(floor(at + 0.5)), ivec3(0), last));
    if (kFilterInHardware) return textureLod(voxels, (at + 0.5) / layer.grid.xyz, 0.0).r;
    ivec3 low = clamp(ivec3(floor(at)), ivec3(0), max(last - 1, ivec3(0)));
    ivec3 high = min(low + 1, last);
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 front = vec4(voxel(low), voxel(ivec3(high.x, low.yz)), voxel(ivec3(low.x, high.y, low.z)),
                      voxel(ivec3(high.xy, low.z)));
    vec4 back = vec4(voxel(ivec3(low.xy, high.z)), voxel(ivec3(high.x, low.y, high.z)),
                     voxel(ivec3(low.x, high.yz)), voxel(high));
    vec4 plane = mix(front, back, t.z);
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// A ray in grid coordinates and its samples.
struct March {
    vec3 origin;
    vec3 direction;  // grid units per world unit
    float begin;     // world units from the ray's origin
    float dt;        // world units a step
    int samples;
};

// Sample `i` lies in the middle of its step.
vec3 positionOf(March march, int i) {
    return march.origin + (march.begin + (float(i) + 0.5) * march.dt) * march.direction;
}

// The brick that holds sample `i`: its range, and the first sample beyond it.
vec2 brickAt(March march, int i, out int beyond) {
    ivec3 lastBrick = max((ivec3(layer.grid.xyz) - 2) / kBrickSize, ivec3(0));
    ivec3 brick = clamp(ivec3(floor(positionOf(march, i))) / kBrickSize, ivec3(0), lastBrick);
    vec3 ahead = vec3(greaterThan(march.direction, vec3(0.0)));
    vec3 wall = (vec3(brick) + ahead) * float(kBrickSize) - march.origin;
    vec3 way = mix(wall / march.direction, vec3(3.0e38), equal(march.direction, vec3(0.0)));
    float leave = min(way.x, min(way.y, way.z));
    float index = (leave - march.begin) / march.dt - 0.5;
    beyond = min(max(int(min(index, float(march.samples))) + 1, i + 1), march.samples);
    return texelFetch(brickRanges, brick, 0).rg;
}

bool stepSample(inout RayState state, March march, int i) {
    float value = valueAt(positionOf(march, i));
    float distance = march.begin + float(i) * march.dt;
    Segment piece = Segment(value, value, value, value, march.dt, distance);
    return stepRay(state, piece) && kEarlyStop;
}

RayState marched(Ray ray, March march) {
    RayState state = beginRay(ray);
    bool finished = false;
    if (!kSkipBricks) {
        for (int i = 0; i < march.samples && !finished; ++i) finished = stepSample(state, march, i);
        return state;
    }
    int i = 0;
    while (i < march.samples && !finished) {
        int beyond;
        vec2 range = brickAt(march, i, beyond);
        if (skipsBetween(state, range.x, range.y)) i = beyond;
        for (; i < beyond && !finished; ++i) finished = stepSample(state, march, i);
    }
    return state;
}

void main() {
    Ray ray = rayThrough(gl_FragCoord.xy);
    March march;
    march.origin = (layer.gridFromData * vec4(ray.origin, 1.0)).xyz;
    march.direction = mat3(layer.gridFromData) * ray.direction;
    vec2 span = boxSpan(march.origin, march.direction, vec3(0.0), layer.grid.xyz - 1.0);
    march.begin = max(span.x, 0.0);
    float end = min(span.y, opaqueDistance(gl_FragCoord.xy));
    if (!(march.begin <= end)) {
        colour = vec4(0.0);
        return;
    }
    float steps = clamp(ceil((end - march.begin) / layer.grid.w), 1.0, float(kMaxRaySamples));
    march.samples = int(steps);
    march.dt = (end - march.begin) / steps;
    colour = endRay(marched(ray, march), 1.0);
}
