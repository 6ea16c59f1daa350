// What passes report to the CPU; zero to begin with.
#include "shared/mesh_bindings.glsl"

layout(std430, binding = kCountStorage) buffer Counts {
    uint nodeCount;        // entries of all pixels, also those that found no room
    uint unfinishedCount;  // rays that need another draw
    uint stepCount;        // of all rays, where they are counted; modulo 2^32
    uint stepCarry;        // how often that began again at 0
};
