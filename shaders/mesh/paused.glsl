// Rays too long for one draw: counted, and on request put aside to go on in the next draw. llvmpipe
// ends all loops of an invocation after 65,535 iterations, without a word.
// Constants: kResumes, kCounts.
#include "mesh/counts.glsl"
#include "mesh/entry_queue.glsl"

const int kNotStarted = 0;
const int kPaused = 1;
const int kFinished = 2;

struct PausedRay {
    ivec4 vertices;  // a, b, c, apex
    ivec4 place;     // cell, last entry's face, one of the words above
    vec4 numbers;    // depth, value, last entry's depth, density
    ivec2 before;    // the cell before, and its vertex that is not on the face
    Segment rest;    // of the piece in hand
    RayState state;
};

layout(std430, binding = kPausedStorage) buffer PausedRays {
    PausedRay pausedRays[];  // one a pixel, row by row; zero to begin with
};

void countUnfinished() {
    atomicAdd(unfinishedCount, 1u);
}

void countSteps(int steps) {
    uint before = atomicAdd(stepCount, uint(steps));
    if (before + uint(steps) < before) atomicAdd(stepCarry, 1u);
}

int slotOf(ivec2 pixel) {
    return pixel.y * int(layer.viewport.x) + pixel.x;
}

bool isFinished(ivec2 pixel) {
    return pausedRays[slotOf(pixel)].place.z == kFinished;
}

// False where the ray has not started.
bool resume(ivec2 pixel, Sight sight, inout RayState state, inout Walk walk, inout Segment rest,
            inout EntryQueue queue) {
    PausedRay ray = pausedRays[slotOf(pixel)];
    if (ray.place.z != kPaused) return false;
    state = ray.state;
    rest = ray.rest;
    Corner a = cornerOf(ray.vertices.x, sight);
    Corner b = cornerOf(ray.vertices.y, sight);
    Corner c = cornerOf(ray.vertices.z, sight);
    vec3 weights = max(vec3(areaOf(b, c), areaOf(c, a), areaOf(a, b)), 0.0);
    walk = Walk(ray.place.x, ray.vertices.w, a, b, c, weights, ray.numbers.x, ray.numbers.y,
                ray.numbers.w, ray.before.x, cornerOf(ray.before.y, sight));
    queue.lastFace = ray.place.y;
    queue.lastDepth = ray.numbers.z;
    return true;
}

void pause(ivec2 pixel, bool ended, RayState state, Walk walk, Segment rest, EntryQueue queue) {
    pausedRays[slotOf(pixel)] =
        PausedRay(ivec4(walk.a.id, walk.b.id, walk.c.id, walk.apex),
                  ivec4(walk.cell, queue.lastFace, ended ? kFinished : kPaused, 0),
                  vec4(walk.depth, walk.value, queue.lastDepth, walk.density),
                  ivec2(walk.left, walk.behind.id), rest, state);
}
