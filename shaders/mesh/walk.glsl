// Walks from cell to cell through a tetrahedral mesh, along the line of each pixel.
//
// The line is the origin of a plane that the vertices are sheared into, so that all questions are
// about signs of areas there: the entry face holds the origin, the fourth vertex splits it into
// three, and the one that holds the origin is the exit. Signs belong to edges and are the same in
// every cell (mesh/mesh.glsl), so each way in has one way out and no walk can turn in circles.
// Cell t: texel 2 t holds the neighbours, 2 t + 1 their fourth vertices, both ordered by the number
// of the vertex opposite the shared face.
// Constants: kValuesAt; kListed: pixels have lists of entries (the mesh is not convex);
// kClipsAtStart: the mesh reaches behind where rays start; kEndsAtSurfaces: opaque layers cut rays;
// kEarlyStop: the model may end a ray; kMaxSteps: a draw; kCounts: rays that need more are
// counted; kResumes: they go on from where the last draw left them.
// Source of the perturbation: H. Edelsbrunner, E. Muecke, Simulation of Simplicity, ACM TOG 9(1),
// 1990.
// Uses: classify and segment through the model.
#include "lib/layer.glsl"
#include "mesh/entry.glsl"
#include "mesh/walk_state.glsl"
#include "mesh/values.glsl"
#include "mesh/entry_queue.glsl"
#include "mesh/paused.glsl"

layout(binding = kCellUnit) uniform isamplerBuffer cellRecords;

layout(location = 0) out vec4 colour;

// What of the line counts, in depth, and the world length of a unit of depth.
struct Span {
    float end;
    float worldPerDepth;
};

int pickId(ivec4 list, int rank) {
    ivec2 pair = rank < 2 ? list.xy : list.zw;
    return (rank & 1) == 0 ? pair.x : pair.y;
}

// Replaces the vertex of the entry face that does not belong to the exit face, and moves on.
// Returns the values at both ends of the line in the cell that was left.
vec2 crossCell(inout Walk walk, Sight sight) {
    Corner q = cornerOf(walk.apex, sight);
    ivec4 neighbours = texelFetch(cellRecords, 2 * walk.cell);
    ivec4 apexes = texelFetch(cellRecords, 2 * walk.cell + 1);
    vec3 areas = vec3(areaOf(q, walk.a), areaOf(q, walk.b), areaOf(q, walk.c));
    bool leftA = isLeft(areas.x, q, walk.a);
    bool leftB = isLeft(areas.y, q, walk.b);
    bool leftC = isLeft(areas.z, q, walk.c);
    bool dropsC = leftA && !leftB;
    bool dropsA = leftB && !leftC;
    bool dropsB = !dropsA && !dropsC;

    CellValues values = valuesIn(walk, q);
    float before = kValuesAt == kValuesAtVertices
                       ? walk.value
                       : valueOn(values.front, walk.weights, walk.value);

    walk.weights = max(vec3(dropsA ? walk.weights.x : dropsB ? areas.z : -areas.y,
                            dropsB ? walk.weights.y : dropsC ? areas.x : -areas.z,
                            dropsC ? walk.weights.z : dropsA ? areas.y : -areas.x), 0.0);
    int dropped = dropsA ? walk.a.id : dropsB ? walk.b.id : walk.c.id;
    int rank = int(walk.a.id < dropped) + int(walk.b.id < dropped) + int(walk.c.id < dropped) +
               int(q.id < dropped);
    vec3 ends = vec3(dropsA ? values.apex : values.front.x, dropsB ? values.apex : values.front.y,
                     dropsC ? values.apex : values.front.z);
    if (dropsA) walk.a = q;
    if (dropsB) walk.b = q;
    if (dropsC) walk.c = q;
    walk.value = valueOn(ends, walk.weights, before);
    float sum = walk.weights.x + walk.weights.y + walk.weights.z;
    vec3 depths = vec3(walk.a.depth, walk.b.depth, walk.c.depth);
    // A face seen edge-on has no depth of its own; depth never goes back.
    walk.depth = sum > 0.0 ? max(walk.depth, dot(walk.weights, depths) / sum) : walk.depth;
    walk.cell = pickId(neighbours, rank);
    walk.apex = pickId(apexes, rank);
    return vec2(before, walk.value);
}

// Hands the model the part of [front, back] that counts. True: the ray is at its end.
bool gather(inout RayState state, vec2 values, float front, float back, Span span) {
    float slope = (values.y - values.x) / max(back - front, 1.0e-30);
    float first = values.x;
    float last = values.y;
    bool counts = true;
    bool ends = false;
    if (kClipsAtStart) {
        counts = back > 0.0;
        first = front < 0.0 ? last - slope * back : first;
    }
    if (kEndsAtSurfaces) {
        ends = back >= span.end;
        counts = counts && front < span.end;
        last = ends ? values.x + slope * (span.end - front) : last;
        back = min(back, span.end);
    }
    if (kClipsAtStart) front = max(front, 0.0);
    if (counts) {
        ends = (stepRay(state, Segment(first, last, (back - front) * span.worldPerDepth,
                                       front * span.worldPerDepth)) && kEarlyStop) || ends;
    }
    return ends;
}

// Goes on until the mesh is left, the ray is at its end (true), or no steps are left.
bool crossCells(inout Walk walk, inout RayState state, inout int steps, Sight sight, Span span) {
    bool ended = false;
    while (walk.cell >= 0 && !ended && steps > 0) {
        --steps;
        float front = walk.depth;
        vec2 values = crossCell(walk, sight);
        ended = gather(state, values, front, walk.depth, span);
    }
    return ended;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Ray ray = rayThrough(gl_FragCoord.xy);
    Sight sight = sightThrough(pictureFrom(gl_FragCoord.xy));
    float worldPerDepth = meshView.raySlope.z * sqrt(1.0 + dot(sight.slope, sight.slope));
    Span span = Span(kEndsAtSurfaces ? opaqueDistance(gl_FragCoord.xy) / worldPerDepth : 0.0,
                     worldPerDepth);

    RayState state = beginRay(ray);
    Walk walk = atStart(sight);
    EntryQueue queue = queueOf(pixel);
    int steps = kMaxSteps;
    bool ended = false;
    bool first = true;
    if (kResumes) {
        if (isFinished(pixel)) {
            colour = vec4(0.0);
            return;
        }
        first = !resume(pixel, sight, state, walk, queue);
    }
    if (!kListed) {
        if (walk.cell < 0 && first) enterFirst(queue, sight, walk);
        ended = crossCells(walk, state, steps, sight, span) || walk.cell < 0;
    } else {
        // Entering is paid for like two steps, scanning the list like one a node.
        while (!ended && steps > 0) {
            steps -= 2;
            if (walk.cell < 0) ended = !enterNext(queue, steps, sight, walk) && steps > 0;
            if (!ended) ended = crossCells(walk, state, steps, sight, span);
        }
    }
    colour = ended && !(kResumes && first) ? endRay(state) : vec4(0.0);
    if (kCounts && !ended) countUnfinished();
    if (kResumes) pause(pixel, ended, state, walk, queue);
}
