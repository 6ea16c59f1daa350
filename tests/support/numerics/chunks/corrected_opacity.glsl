// Corrected opacity of one pair (a, r) a pixel.
#include "lib/opacity_correction.glsl"

vec3 weightsOf(float a, float r) {
    return vec3(correctedOpacity(a, r), 0.0, 0.0);
}
#include "weights_main.glsl"
