// Walks from cell to cell through a tetrahedral mesh, along the line of each pixel.
//
// The line is the origin of a plane that the vertices are sheared into, so that all questions are
// about signs of areas there: the entry face holds the origin, the fourth vertex splits it into
// three, and the one that holds the origin is the exit. Signs belong to edges and are the same in
// every cell (mesh/mesh.glsl), so each way in has one way out and no walk can turn in circles.
// Cell t: texel 2 t holds the neighbours, 2 t + 1 their fourth vertices, both ordered by the number
// of the vertex opposite the shared face.
//
// A model may take a cell's piece in parts, as where its map bends. That costs much more than to take
// it whole, few cells need it, and on llvmpipe all rays of a group run what one of them needs. So a
// round crosses up to kCellsARound cells that are taken whole, rays that meet another one wait, and
// then take up to kPartsARound parts of it. (Measured against one loop in which each ray crosses a
// cell or takes a part: a tenth faster with smooth maps, a third slower where all cells have parts.)
// Constants: kValuesAt, kDensityAt; kListed: pixels have lists of entries (the mesh is not convex);
// kContinuous: a piece's front values are the back values of the one before; those of
// mesh/trim.glsl; kEarlyStop: the model may end a ray; kSplits: pieces are taken in parts;
// kPartByPart: by a user's code, of kIterationsAPart rounds; kMaxRounds: a draw; kCellsARound, kPartsARound; kCounts: rays that need more are counted; kResumes: they go on from where the
// last draw left them; kCountsSteps; kLit.
// Source of the perturbation: H. Edelsbrunner, E. Muecke, Simulation of Simplicity, ACM TOG 9(1),
// 1990.
// Uses: model.
#include "mesh/trim.glsl"
#include "mesh/entry.glsl"
#include "mesh/walk_state.glsl"
#include "mesh/values.glsl"
#include "mesh/entry_queue.glsl"
#include "mesh/paused.glsl"

layout(binding = kCellUnit) uniform isamplerBuffer cellRecords;

int pickId(ivec4 list, int rank) {
    ivec2 pair = rank < 2 ? list.xy : list.zw;
    return (rank & 1) == 0 ? pair.x : pair.y;
}

int stepsTaken = 0;  // kCountsSteps: cells crossed and parts taken

// Replaces the vertex of the entry face that does not belong to the exit face, and moves on.
// Returns the line's piece in the cell that was left.
Segment crossCell(inout Walk walk, Sight sight, float worldPerDepth) {
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

    CellValues values = valuesIn(walk.cell, walk.a, walk.b, walk.c, q);
    CellValues densities = densitiesIn(walk.cell, walk.a, walk.b, walk.c, q);
    Segment piece;
    piece.front = kValuesAt == kValuesAtVertices
                      ? walk.value
                      : valueOn(kValuesAt, values.front, walk.weights, walk.value);
    piece.densityFront = kDensityAt == kValuesAtVertices
                             ? walk.density
                             : valueOn(kDensityAt, densities.front, walk.weights, walk.density);
    float front = walk.depth;

    walk.weights = max(vec3(dropsA ? walk.weights.x : dropsB ? areas.z : -areas.y,
                            dropsB ? walk.weights.y : dropsC ? areas.x : -areas.z,
                            dropsC ? walk.weights.z : dropsA ? areas.y : -areas.x), 0.0);
    int dropped = dropsA ? walk.a.id : dropsB ? walk.b.id : walk.c.id;
    int rank = int(walk.a.id < dropped) + int(walk.b.id < dropped) + int(walk.c.id < dropped) +
               int(q.id < dropped);
    bvec3 drops = bvec3(dropsA, dropsB, dropsC);
    vec3 ends = mix(values.front, vec3(values.apex), drops);
    vec3 densityEnds = mix(densities.front, vec3(densities.apex), drops);
    walk.left = walk.cell;
    if (dropsA) walk.behind = walk.a;
    if (dropsB) walk.behind = walk.b;
    if (dropsC) walk.behind = walk.c;
    if (dropsA) walk.a = q;
    if (dropsB) walk.b = q;
    if (dropsC) walk.c = q;
    walk.value = valueOn(kValuesAt, ends, walk.weights, piece.front);
    walk.density = valueOn(kDensityAt, densityEnds, walk.weights, piece.densityFront);
    float sum = walk.weights.x + walk.weights.y + walk.weights.z;
    vec3 depths = vec3(walk.a.depth, walk.b.depth, walk.c.depth);
    // A face seen edge-on has no depth of its own; depth never goes back.
    float depth = meanOf(depths, walk.weights, walk.depth);
    walk.depth = depth > walk.depth ? depth : walk.depth;
    walk.cell = pickId(neighbours, rank);
    walk.apex = pickId(apexes, rank);
    piece.back = walk.value;
    piece.densityBack = walk.density;
    if (kDensityAt == kValuesNowhere) {
        piece.densityFront = piece.front;
        piece.densityBack = piece.back;
    }
    piece.extent = (walk.depth - front) * worldPerDepth;
    piece.distance = front * worldPerDepth;
    return piece;
}

// The line of a pixel, and what of it counts.
struct Line {
    Sight sight;
    Window window;
    float worldPerDepth;
};

// The piece that begins where a walk enters; of length 0.
Segment startOf(Walk walk, float worldPerDepth) {
    float density = kDensityAt == kValuesNowhere ? walk.value : walk.density;
    return Segment(walk.value, walk.value, density, density, 0.0, walk.depth * worldPerDepth);
}

void enterAt(inout RayState state, Walk walk, Line line) {
    if (kContinuous) enterData(state, startOf(walk, line.worldPerDepth));
}

// Nothing may be left of a cell's piece when the model's turn comes.
const bool kMayBeEmpty = kCutsFront || kCutsBack || kInterval;

// Hands the model a part of `rest`. True: the ray is at its end.
bool gather(inout RayState state, inout Segment rest, Walk walk, Line line) {
    if (kCountsSteps) ++stepsTaken;
    bool ended = false;
    if (!kMayBeEmpty || rest.extent >= 0.0) ended = stepRay(state, rest) && kEarlyStop;
    bool past = kCutsBack && walk.depth * line.worldPerDepth >= line.window.end;
    return ended || (past && (!kSplits || rest.extent < 0.0));
}

// Crosses a cell. True: the ray is at its end.
bool stepOn(inout Walk walk, inout RayState state, inout Segment rest, Line line) {
    rest = trimmed(crossCell(walk, line.sight, line.worldPerDepth), line.window);
    if (!kContinuous && rest.extent >= 0.0) enterData(state, rest);
    return gather(state, rest, walk, line);
}

bool crossInRounds(inout Walk walk, inout RayState state, inout Segment rest, inout int rounds,
                   Line line) {
    bool ended = false;
    while ((walk.cell >= 0 || rest.extent >= 0.0) && !ended && rounds > 0) {
        --rounds;
        wholePieces = true;
        int cells = rest.extent < 0.0 ? kCellsARound : 0;
        do {
            if (cells > 0) {
                --cells;
                ended = stepOn(walk, state, rest, line);
            }
        } while (cells > 0 && walk.cell >= 0 && rest.extent < 0.0 && !ended);
        wholePieces = false;
        int parts = kPartsARound;
        do {
            if (rest.extent >= 0.0 && !ended) {
                ended = gather(state, rest, walk, line);
            }
            --parts;
        } while (parts > 0 && rest.extent >= 0.0 && !ended);
    }
    return ended;
}

// The walk behind the cell that a piece lies in, and the world units in a unit of depth on its line:
// for models that ask for more than a piece says.
Walk pieceWalk;
float pieceScale;

// One part a round, and before it a cell where nothing of the last one is left: a user's code costs
// more than a cell, and is in the program once. Its own loops count as rounds.
bool crossPartByPart(inout Walk walk, inout RayState state, inout Segment rest, inout int rounds,
                     Line line) {
    bool ended = false;
    pieceScale = line.worldPerDepth;
    while ((walk.cell >= 0 || rest.extent >= 0.0) && !ended && rounds > 0) {
        rounds -= kIterationsAPart;
        if (rest.extent < 0.0) {
            rest = trimmed(crossCell(walk, line.sight, line.worldPerDepth), line.window);
        }
        pieceWalk = walk;
        ended = gather(state, rest, walk, line);
    }
    return ended;
}

// Goes on until the mesh is left, the ray is at its end (true), or no rounds are left: cells, or
// where pieces have parts some cells.
bool crossCells(inout Walk walk, inout RayState state, inout Segment rest, inout int rounds,
                Line line) {
    if (kPartByPart) return crossPartByPart(walk, state, rest, rounds, line);
    if (kSplits) return crossInRounds(walk, state, rest, rounds, line);
    bool ended = false;
    while (walk.cell >= 0 && !ended && rounds > 0) {
        --rounds;
        ended = stepOn(walk, state, rest, line);
    }
    return ended;
}

float facingAt(Walk walk, Sight sight) {
    if (!kLit || walk.left < 0) return 1.0;
    CellValues values = valuesIn(walk.left, walk.a, walk.b, walk.c, walk.behind);
    return facingIn(walk.a, walk.b, walk.c, walk.behind, values, sight.slope);
}

Line lineOf(vec2 pixel) {
    Sight sight = sightThrough(pictureFrom(pixel));
    return Line(sight, windowOf(rayThrough(pixel), pixel), worldPerDepth(sight));
}

// What the ray of a pixel gathers, and how far away it was ended by something opaque. False: not
// yet known, the ray goes on in the next draw, or known since an earlier one.
bool castRay(out vec4 gathered, out float distance) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    gathered = vec4(0.0);
    distance = kNoHit;
    Line line = lineOf(gl_FragCoord.xy);
    RayState state = beginRay(rayThrough(gl_FragCoord.xy));
    Walk walk = atStart(line.sight);
    if (walk.cell >= 0) enterAt(state, walk, line);
    Segment rest = kNoSegment;
    EntryQueue queue = queueOf(pixel);
    int rounds = kMaxRounds;
    bool ended = false;
    bool first = true;
    if (kResumes) {
        if (isFinished(pixel)) return false;
        first = !resume(pixel, line.sight, state, walk, rest, queue);
    }
    if (!kListed) {
        if (walk.cell < 0 && first) {
            enterFirst(queue, line.sight, walk);
            enterAt(state, walk, line);
        }
        ended = crossCells(walk, state, rest, rounds, line) || (walk.cell < 0 && rest.extent < 0.0);
    } else {
        // Entering is paid for like two rounds, scanning the list like one a node.
        while (!ended && rounds > 0) {
            rounds -= 2;
            if (walk.cell < 0 && rest.extent < 0.0) {
                ended = !enterNext(queue, rounds, line.sight, walk) && rounds > 0;
                if (!ended) enterAt(state, walk, line);
            }
            if (!ended) ended = crossCells(walk, state, rest, rounds, line);
        }
    }
    if (kCountsSteps) countSteps(stepsTaken);
    if (kCounts && !ended) countUnfinished();
    if (kResumes) pause(pixel, ended, state, walk, rest, queue);
    if (!ended || (kResumes && first)) return false;
    gathered = endRay(state, facingAt(walk, line.sight));
    distance = hitDistance(state);
    return true;
}
