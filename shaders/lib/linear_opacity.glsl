// The share of one piece whose colours count as in a thin one: returns (h, alpha), so that the piece
// adds alpha ((1 - h) front + h back). a, b: optical depths of its near and its far end, >= 0.
//
// alpha is that of the mean extinction, exact. h = 1/2 + r/6 with r = (b - a)/(a + b) is the limit
// of the exact share for small depths: int t (a + (b - a) t) dt / int (a + (b - a) t) dt. It stays
// in [1/3, 2/3] and leaves out that the near end hides the far one: off by up to 2/3 - 1/m there.
// Source of the exact share: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for
// Unstructured Data, VolVis 2004, section 3.
#include "lib/opacity.glsl"

vec2 linearOpacity(float a, float b) {
    float sum = a + b;
    float r = sum > 0.0 ? (b - a) / sum : 0.0;
    return vec2(0.5 + r * (1.0 / 6.0), opacityOf(0.5 * sum));
}
