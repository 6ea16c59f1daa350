// As segment/exact.glsl calls it; right only for a, b <= 1/2.
#include "lib/psi_short.glsl"

vec3 weightsOf(float a, float b) {
    vec2 share = psiShort(0.5 * (a + b), 0.5 * (b - a));
    return vec3(0.5 * share.x - share.y, 0.5 * share.x + share.y, share.x);
}
#include "weights_main.glsl"
