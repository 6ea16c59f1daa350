// Opacity over r times the length that has opacity a: 1 - (1 - a)^r, for a in [0, 1], r >= 0.
//
// pow(1 - a, r) loses a below 1e-4: 1 - a rounds it away. -expm1(r log1p(-a)) keeps all digits:
//   log1p  as log(u) a / (1 - u) with u = 1 - a as rounded: the quotient undoes the rounding.
//          Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 1.14.
//   expm1  the opacity of an optical depth.
#include "lib/opacity.glsl"

// -log(1 - a), the optical depth of opacity a; 1 counts as the next smaller number.
float depthOfOpacity(float a) {
    precise float u = 1.0 - a;
    precise float lost = 1.0 - u;
    // Below 1/16 a series; log() near 1 has an absolute error of its own on many GPUs.
    float series = a * (1.0 + a * (1.0 / 2.0 + a * (1.0 / 3.0 + a * (1.0 / 4.0 + a * (1.0 / 5.0 +
                   a * (1.0 / 6.0))))));
    float exact = -log(max(u, 5.9604645e-08)) * (a / max(lost, 1.0e-30));
    return a < 0.0625 ? series : exact;
}

float correctedOpacity(float a, float r) {
    return opacityOf(r * depthOfOpacity(a));
}
