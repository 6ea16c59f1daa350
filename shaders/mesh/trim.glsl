// Cuts a cell's piece to what counts of it.
// Constants: kInterval: only values in an interval count; those of lib/window.glsl.
#include "lib/window.glsl"

// The part of `piece` from share `t0` to share `t1` of its length.
Segment partOf(Segment piece, float t0, float t1) {
    return Segment(mix(piece.front, piece.back, t0), mix(piece.front, piece.back, t1),
                   mix(piece.densityFront, piece.densityBack, t0),
                   mix(piece.densityFront, piece.densityBack, t1), (t1 - t0) * piece.extent,
                   piece.distance + t0 * piece.extent);
}

const Segment kNoSegment = Segment(0.0, 0.0, 0.0, 0.0, -1.0, 0.0);

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

Segment inInterval(Segment piece) {
    if (!kInterval) return piece;
    float low = layer.gather.z;
    float high = layer.gather.w;
    float first = clamp(piece.front, low, high);
    float last = clamp(piece.back, low, high);
    bool flatOutside = first == last && (first != piece.front || last != piece.back) &&
                       !(first == piece.front || last == piece.back);
    if (piece.extent < 0.0 || flatOutside) return kNoSegment;
    float span = piece.back - piece.front;
    float t0 = first == piece.front ? 0.0 : clamp((first - piece.front) / span, 0.0, 1.0);
    float t1 = last == piece.back ? 1.0 : clamp((last - piece.front) / span, t0, 1.0);
    Segment part = partOf(piece, t0, t1);
    part.front = first;
    part.back = last;
    return part;
}

Segment trimmed(Segment piece, Window window) {
    return inInterval(inWindow(piece, window));
}
