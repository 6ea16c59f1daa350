// Cuts a cell's piece to what counts of it.
// Constants: those of lib/interval.glsl and lib/window.glsl.
#include "lib/interval.glsl"
#include "lib/window.glsl"

Segment inWindow(Segment piece, Window window) {
    if (!kCutsFront && !kCutsBack) return piece;
    float last = piece.distance + piece.extent;
    if (last < window.begin || piece.distance >= window.end) return kNoSegment;
    bool cuts = piece.distance < window.begin || last > window.end;
    float scale = piece.extent > 0.0 ? 1.0 / piece.extent : 0.0;
    float t0 = clamp((window.begin - piece.distance) * scale, 0.0, 1.0);
    float t1 = clamp((window.end - piece.distance) * scale, t0, 1.0);
    return cuts ? partOf(piece, t0, t1) : piece;
}

Segment trimmed(Segment piece, Window window) {
    return inInterval(inWindow(piece, window));
}
