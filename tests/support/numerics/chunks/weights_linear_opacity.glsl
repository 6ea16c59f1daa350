#include "lib/linear_opacity.glsl"

vec3 weightsOf(float a, float b) {
    vec2 share = linearOpacity(a, b);
    float back = share.x * share.y;
    return vec3(share.y - back, back, share.y);
}
#include "weights_main.glsl"
