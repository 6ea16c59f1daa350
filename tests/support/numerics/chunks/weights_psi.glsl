#include "lib/psi.glsl"

vec3 weightsOf(float a, float b) {
    return psiWeights(a, b);
}
#include "weights_main.glsl"
