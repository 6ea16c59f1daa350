// The share of one thin piece with linear colour and linear extinction: both depths at most 1/2.
//
// With optical depths a and b (extinction times length at the near and the far end), m = (a + b)/2
// and e = (b - a)/2, the piece covers alpha and adds alpha (front + back)/2 + lean (back - front).
// Returns (alpha, lean). About the middle of the piece, y in [-1/2, 1/2],
//     alpha = 1 - exp(-m),  lean = alpha (h - 1/2),
//     h = 1/2 + m / (2 sinh(m/2)) int y (1 + 2 r y) exp(-m y - m r (y y - 1/4)) dy,  r = e/m,
// and h - 1/2 changes sign with (m, r): it is r o(m^2, r^2) + m k(m^2, r^2). As alpha is m p(m), lean
// is a polynomial in e, e^2 and m^2 times p: no division. The polynomials are minimax in the relative
// error of h, 2.1e-7, and of alpha, 8e-8 (tests/support/numerics/fit_psi.py). h <= 2/3 always.
// Needs no exp, erfc or Dawson; outside max(a, b) <= 1/2 it is wrong: use psi.glsl.
// Source of the weights: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for
// Unstructured Data, VolVis 2004.
vec2 psiShort(float m, float e) {
    float mm = m * m;
    float ee = e * e;
    float lean = e * (0.166666597 + mm * -0.00276790489 + ee * 0.00118235848) +
                 (mm * (-0.0833327398 + mm * 0.00137906289 + ee * -0.000375933625) +
                  ee * (0.0166652855 + ee * 6.3933272e-05));
    float p = (0.99999996 + m * -0.49999338) +
              mm * ((0.16655441 + m * -0.04101783) + mm * 0.00678564);
    return p * vec2(m, lean);
}
