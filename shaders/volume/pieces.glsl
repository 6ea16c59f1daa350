// What the march hands to a model that integrates between samples: pieces in which the field runs
// linearly, cut to the interval and taken in parts where the map bends.
//
// llvmpipe ends all loops of an invocation after 65,535 rounds in total, so a ray has a number of
// parts to spend. Behind them what is left of each piece counts as its front value.
// Constants: kSplits: pieces are taken in parts; kMaxRayParts; kEarlyStop; those of lib/interval.glsl.
// Uses: model.
#include "lib/interval.glsl"

int partsLeft = kMaxRayParts;

// True: nothing behind can show.
bool takePiece(inout RayState state, Segment piece) {
    if (lacksValue(piece.front) || lacksValue(piece.back)) return false;
    Segment rest = inInterval(piece);
    if (kInterval && rest.extent < 0.0) return false;
    if (kInterval || kMissing || (kSplits && partsLeft < 0)) enterData(state, rest);
    wholePieces = kSplits;
    bool ended = stepRay(state, rest) && kEarlyStop;
    wholePieces = false;
    while (kSplits && rest.extent >= 0.0 && !ended) {
        --partsLeft;
        if (partsLeft < 0) rest.back = rest.front;
        if (partsLeft < 0) rest.densityBack = rest.densityFront;
        ended = stepRay(state, rest) && kEarlyStop;
    }
    return ended;
}
