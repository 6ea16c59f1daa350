// The share of one piece with linear colour and opacity, approximately: returns (h, alpha), so that
// the piece adds alpha ((1 - h) front + h back). a, b: optical depths of its near and its far end,
// >= 0.
//
// Source: K. Moreland, Fast High Accuracy Volume Rendering, PhD thesis, University of New Mexico,
// 2004, section 1.3.2, Improved Approximation. With opacities F and B per unit of length at the
// near and the far end of a piece of length L, the weights of the ends are 1 - Psi and Psi - zeta:
//     zeta = (1 - (F + B)/2 - 0.108165 (B - F)^2)^L,
//     Psi = (1 - exp(-t))/t,  t = -L log(1 - 0.73 F - 0.27 B).
// Opacities per unit depend on the unit, pictures must not. So this is the limit for small units:
// in n units a piece has F = a/n, B = b/n, L = n, and for n to infinity the square vanishes:
//     zeta = exp(-m),  m = (a + b)/2,  t = 0.73 a + 0.27 b.
// zeta is exact, and so is Psi where a = b. As Psi >= exp(-t/2) >= zeta, h is never below 0; the
// exact share is never above 2/3, so h may not be either.
#include "lib/opacity.glsl"

vec2 linearOpacity(float a, float b) {
    float m = 0.5 * a + 0.5 * b;
    float t = 0.73 * a + 0.27 * b;
    float alpha = opacityOf(m);
    // 1 - Psi where it is small: the terms of opacityOf(t), each divided by -t, but for the first.
    float front = t * (1.0 / 2.0) * (1.0 - t * (1.0 / 3.0) * (1.0 - t * (1.0 / 4.0) *
                  (1.0 - t * (1.0 / 5.0) * (1.0 - t * (1.0 / 6.0) * (1.0 - t * (1.0 / 7.0) *
                  (1.0 - t * (1.0 / 8.0)))))));
    float back = t < 0.5 ? alpha - front : (1.0 - exp(-t)) / t - exp(-m);
    // Below 1e-37 alpha is no normal number: drivers may flush it in the division.
    // The largest share is the float32 whose product with alpha cannot round above 2/3 alpha.
    return vec2(alpha < 1.0e-37 ? 0.5 : clamp(back / alpha, 0.0, 0.66666662), alpha);
}
