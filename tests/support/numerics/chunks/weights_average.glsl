// Both ends count alike, as in segment/average.glsl where the map is linear between them.
#include "lib/opacity.glsl"

vec3 weightsOf(float a, float b) {
    float alpha = opacityOf(0.5 * a + 0.5 * b);
    return vec3(0.5 * alpha, 0.5 * alpha, alpha);
}
#include "weights_main.glsl"
