// As segment/exact.glsl calls it; right only for a, b <= 1/2.
#include "lib/psi_short.glsl"

vec3 weightsOf(float a, float b) {
    float sum = a + b;
    vec2 share = psiShort(0.5 * sum, sum > 0.0 ? (b - a) / sum : 0.0);
    float back = share.x * share.y;
    return vec3(share.y - back, back, share.y);
}
#include "weights_main.glsl"
