// Where a line enters the mesh.
#include "mesh/mesh.glsl"

struct Entry {
    int face;      // boundary face, or -1: the line misses the mesh here
    int cell;
    int apex;      // the cell's vertex that is not on the face
    Corner a, b, c;
    vec3 weights;  // of a, b, c; their areas, not divided by the sum
};

Entry entryAt(int face, Sight sight) {
    ivec4 record = texelFetch(boundaryRecords, 2 * face);
    int apex = texelFetch(boundaryRecords, 2 * face + 1).w;
    Corner a = cornerOf(record.y, sight);
    Corner b = cornerOf(record.z, sight);
    Corner c = cornerOf(record.w, sight);
    return Entry(face, record.x, apex, a, b, c,
                 vec3(areaOf(b, c), areaOf(c, a), areaOf(a, b)));
}

// The face that was rasterised is drawn a little too large and may be next to the one that the line
// meets: cross edges that the line is outside of, at most 6 times.
Entry repairedEntry(int face, Sight sight) {
    Entry entry = entryAt(face, sight);
    for (int hop = 0; hop < 6; ++hop) {
        bvec3 inside = bvec3(isLeft(entry.weights.x, entry.b, entry.c),
                             isLeft(entry.weights.y, entry.c, entry.a),
                             isLeft(entry.weights.z, entry.a, entry.b));
        if (all(inside)) return entry;
        if (!any(inside)) break;  // Seen from behind: past the silhouette.
        ivec4 across = texelFetch(boundaryRecords, 2 * entry.face + 1);
        int next = !inside.z ? across.x : !inside.x ? across.y : across.z;
        if (next < 0) break;
        entry = entryAt(next, sight);
    }
    entry.face = -1;
    return entry;
}

// Depth at which the line crosses a face of which the weights are known; always between the depths
// of its corners. A face seen exactly edge-on is met at its nearest corner.
float depthOn(Corner a, Corner b, Corner c, vec3 weights) {
    vec3 w = max(weights, 0.0);
    float sum = w.x + w.y + w.z;
    vec3 depths = vec3(a.depth, b.depth, c.depth);
    return sum > 0.0 ? dot(w, depths) / sum : min(depths.x, min(depths.y, depths.z));
}
