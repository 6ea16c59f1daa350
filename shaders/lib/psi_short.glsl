// The share of one thin piece with linear colour and linear extinction: both depths at most 1/2.
//
// With optical depths a and b (extinction times length at the near and the far end), m = (a + b)/2
// and r = (b - a)/(a + b), the piece adds alpha ((1 - h) front + h back) and covers alpha.
// Returns (h, alpha). About the middle of the piece, y in [-1/2, 1/2],
//     alpha = 1 - exp(-m),
//     h = 1/2 + m / (2 sinh(m/2)) int y (1 + 2 r y) exp(-m y - m r (y y - 1/4)) dy,
// so h - 1/2 changes sign with (m, r): it is r o(m^2, r^2) + m k(m^2, r^2). The polynomials are
// minimax in the relative error of h, 2.1e-7, and of alpha, 8e-8 (tests/support/numerics/fit_psi.py);
// measured in float32: h 3.5e-7, alpha 2.0e-7, the back weight 4.9e-7. h <= 2/3 always.
// Needs no exp, erfc or Dawson; outside max(a, b) <= 1/2 it is wrong: use psi.glsl.
// Source of the weights: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for
// Unstructured Data, VolVis 2004.
vec2 psiShort(float m, float r) {
    float mm = m * m;
    float rr = r * r;
    float odd = 0.166666597 + mm * (-0.00276790489 + rr * 0.00118235848);
    float even = -0.0833327398 + rr * 0.0166652855 +
                 mm * (0.00137906289 + rr * (-0.000375933625 + rr * 6.3933272e-05));
    float h = 0.5 + r * odd + m * even;
    float alpha = m * (0.99999996 + m * (-0.49999338 + m * (0.16655441 +
                  m * (-0.04101783 + m * 0.00678564))));
    return vec2(h, alpha);
}
