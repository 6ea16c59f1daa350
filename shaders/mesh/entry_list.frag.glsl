// All faces where each pixel's line enters a mesh, as linked lists in no order. Nodes that do not
// fit are counted all the same, so that the caller sees how many there are.
#include "lib/layer.glsl"
#include "mesh/counts.glsl"
#include "mesh/entry.glsl"

layout(binding = kHeadImage, r32i) uniform iimage2D heads;
layout(std430, binding = kNodeStorage) writeonly buffer Nodes {
    ivec4 nodes[];  // face, bits of its depth, next node or -1
};

void main() {
    if (gl_HelperInvocation) return;
    Entry entry = repairedEntry(gl_PrimitiveID, sightThrough(pictureFrom(gl_FragCoord.xy)));
    if (entry.face < 0) return;
    float depth = depthOn(entry.a, entry.b, entry.c, entry.weights);
    uint node = atomicAdd(nodeCount, 1u);
    if (node >= uint(nodes.length())) return;
    int next = imageAtomicExchange(heads, ivec2(gl_FragCoord.xy), int(node));
    nodes[node] = ivec4(entry.face, floatBitsToInt(depth), next, 0);
}
