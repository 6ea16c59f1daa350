// The part of a piece whose values are in the layer's interval.
// Constants: kInterval: only values in an interval count.
#include "lib/layer_uniforms.glsl"

// The part of `piece` from share `t0` to share `t1` of its length.
Segment partOf(Segment piece, float t0, float t1) {
    return Segment(mix(piece.front, piece.back, t0), mix(piece.front, piece.back, t1),
                   mix(piece.densityFront, piece.densityBack, t0),
                   mix(piece.densityFront, piece.densityBack, t1), (t1 - t0) * piece.extent,
                   piece.distance + t0 * piece.extent);
}

const Segment kNoSegment = Segment(0.0, 0.0, 0.0, 0.0, -1.0, 0.0);

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
