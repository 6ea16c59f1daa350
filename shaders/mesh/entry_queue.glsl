// The boundary faces where a pixel's line enters the mesh, front to back.
// Constants: kListed: all of them, from a list in no order; otherwise one.
#include "mesh/walk_state.glsl"

layout(binding = kEntryUnit) uniform isampler2D entries;
layout(binding = kEntryNodeUnit) uniform isamplerBuffer entryNodes;

struct EntryQueue {
    int head;         // node, or face where there is one at most; -1: none
    float lastDepth;  // of the entry used last
    int lastFace;
};

EntryQueue queueOf(ivec2 pixel) {
    return EntryQueue(texelFetch(entries, pixel, 0).r, -3.0e38, -1);
}

void enterFirst(EntryQueue queue, Sight sight, inout Walk walk) {
    if (queue.head >= 0) walk = walkFrom(entryAt(queue.head, sight));
}

// Enters at the next face behind the last, by depth and then by number; a face that the list names
// twice is entered once. False where there is none, or where `steps` did not suffice to look.
bool enterNext(inout EntryQueue queue, inout int steps, Sight sight, inout Walk walk) {
    float depth = 3.0e38;
    int face = -1;
    int node = queue.head;
    while (node >= 0 && steps > 0) {
        --steps;
        ivec4 entry = texelFetch(entryNodes, node);
        float entryDepth = intBitsToFloat(entry.y);
        bool behind = entryDepth > queue.lastDepth ||
                      (entryDepth == queue.lastDepth && entry.x > queue.lastFace);
        bool nearer = entryDepth < depth || (entryDepth == depth && entry.x < face);
        if (behind && nearer) {
            depth = entryDepth;
            face = entry.x;
        }
        node = entry.z;
    }
    if (face < 0 || node >= 0) return false;
    queue.lastDepth = depth;
    queue.lastFace = face;
    walk = walkFrom(entryAt(face, sight));
    return true;
}
