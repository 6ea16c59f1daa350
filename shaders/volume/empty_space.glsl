// Where nothing shows of a volume: see renderer/volume/empty_space.h.
// Constants: kRangeBlock.
#include "lib/layer.glsl"

layout(binding = kEmptySpaceUnit) uniform usamplerBuffer emptySpace;  // bytes: blocks, x fastest

// Computed before any loop, because llvmpipe reads a uniform again in each round: see
// classify/transfer_function.glsl.
ivec3 lastApart = (ivec3(layer.grid.xyz + max(-gl_FragCoord.x, 0.0)) - 1) / kRangeBlock;
int apartRow = lastApart.x + 1;
int apartLayer = apartRow * (lastApart.y + 1);

// How far a ray goes on from a point in the box without meeting anything that shows: world units,
// where `perGrid` has those that each axis takes for a grid interval. `shows`: the point's own block
// does, and the answer has no meaning.
float emptyFrom(vec3 at, vec3 perGrid, out bool shows) {
    ivec3 block = min(ivec3(at * (1.0 / float(kRangeBlock))), lastApart);
    int index = block.z * apartLayer + block.y * apartRow + block.x;
    uint word = texelFetch(emptySpace, index >> 2).r;
    float apart = float(word >> (8 * (index & 3)) & 255u);
    shows = apart == 0.0;
    // Blocks that are nearer along each axis show nothing: to the wall that the ray leaves them by.
    vec3 beyond = mix(vec3(1.0), vec3(-1.0), lessThan(perGrid, vec3(0.0))) * (apart - 0.5);
    vec3 way = ((vec3(block) + 0.5 + beyond) * float(kRangeBlock) - at) * perGrid;
    return min(way.x, min(way.y, way.z));
}
