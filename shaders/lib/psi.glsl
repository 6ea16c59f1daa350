// The weights of one ray segment with linear colour and linear extinction, for all depths.
//
// a and b are the optical depths (extinction times length) of its near and its far end, >= 0. The
// segment adds wFront front + wBack back and covers alpha = wFront + wBack; psiWeights returns
// (wFront, wBack, alpha). With m = (a + b)/2, e = (b - a)/2 and z = exp(-m):
//     alpha = 1 - z,  wBack = Psi - z,  Psi = int_0^1 exp(-a s - e s s) ds.
// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data, VolVis
// 2004. Their closed form loses all digits in float32 for thin or even segments, so:
//   m < 2   about the middle, y in [-1/2, 1/2]: wBack = alpha/2 + sqrt(z) (e/6 + N),
//           e/6 + N = int y (m + 2 e y) exp(-m y - e (y y - 1/4)) dy, entire and even in m: a
//           polynomial in (m m, e) without a division, whose terms all vanish with m and e.
//   m >= 2  Psi = P(a) - z P(b) with P(c) = int_0^inf exp(-c s - e s s) ds, by erfcx for e >= 0 and
//           by Dawson's integral for e < 0 (Abramowitz and Stegun, 7.1 and 7.4.2). Both are
//           written so that e = 0 is no division by zero: P = 1/c there.
// Coefficients: minimax in the relative error (tests/support/numerics/fit_psi.py), at most 5e-8.
// Inputs above 1e30 count as 1e30. Depths below 1e-37 give zero: their weights are not normal
// numbers, and many drivers flush those. 0 <= wBack <= 2/3 alpha holds exactly.

// int_0^inf exp(-c s - r r s s) ds; not for c = r = 0. With x = c/(2 r) it is
// erfcx(x) sqrt(pi)/(2 r): a polynomial in q = (1 - x/2) / (1 + x/2), over r (1 + x/2).
float psiRising(float c, float r) {
    float w = 1.0 / (r + 0.25 * c);
    float q = (r - 0.25 * c) * w;
    return w * (0.452677041 + q * (0.304490119 + q * (0.123837553 + q * (0.0161487367 +
           q * (-0.00952813588 + q * (-0.00287527661 + q * (0.00135418552 + q * (0.000382929138 +
           q * (-0.000263862574 + q * (-3.30494331e-05 + q * 3.66644781e-05))))))))));
}

// What replaces it for e = -f < 0 and leaves the same difference: dawson(x)/sqrt(f) with
// x = c/(2 sqrt(f)). Up to x = 3 as g dawson(x)/x with g = x/sqrt(f), which also makes x x: where
// x is large, both errors of a rounded g cancel. Beyond, 2 x dawson(x) / c, a polynomial in
// 1/(4 x x).
float psiFalling(float c, float f) {
    if (c * c < 36.0 * f) {
        float g = 0.5 * c / f;
        float u = 0.5 * c * g;
        float up = 1.0 + u * (-0.0930278897 + u * (0.0365199707 + u * (-0.000559670967 +
                   u * (0.000150506938 + u * -1.33929893e-06))));
        float down = 1.0 + u * (0.573639512 + u * (0.152274594 + u * (0.0241903737 +
                     u * (0.00242569111 + u * 0.000150602253))));
        return up * (g / down);
    }
    float w = 1.0 / c;
    float y = f * w * w;
    return w * (1.0 + y * (2.0001483 + y * (11.8115292 + y * (211.767578 + y * (-20510.3086 +
           y * (3002462.75 + y * (-227972272.0 + y * (9.89858099e+09 + y * (-2.16394252e+11 +
           y * 1.83712534e+12)))))))));
}

vec3 psiWeights(float a, float b) {
    a = min(a, 1.0e30);
    b = min(b, 1.0e30);
    float m = 0.5 * a + 0.5 * b;
    float e = 0.5 * b - 0.5 * a;
    float alpha = 0.0;
    float back = 0.0;
    if (m < 2.0) {
        float mm = m * m;
        float x = 0.5 * m;
        // hidden = 1 - sqrt(z), so alpha = 2 hidden - hidden^2 = m - 2 excess - hidden^2: where m
        // is small the others hardly count, and only this difference rounds. From m = 2 log 2 on,
        // hidden is at least 1/2 and 1 - hidden does not round: 1 - (1 - hidden)^2 is closer then.
        float excess = x * x * (0.499999851 + x * (-0.166663662 + x * (0.0416474678 +
                       x * (-0.0082762083 + x * (0.00130112644 + x * -0.000129130916)))));
        float hidden = x - excess;
        float n0 = mm * (-0.0833333358 + mm * (-0.00208334276 + mm * (-1.85921363e-05 +
                   mm * -8.87652902e-08)));
        float n1 = -4.96730479e-09 + mm * (0.00416668085 + mm * (3.71898641e-05 +
                   mm * 1.76923564e-07));
        float n2 = 0.0166666713 + mm * (0.000297649472 + mm * (2.04109483e-06 +
                   mm * 1.20521131e-08));
        float n3 = 0.00119046855 + mm * (1.6525395e-05 + mm * 9.43758991e-08);
        float n4 = 6.60977676e-05 + mm * 7.79443894e-07;
        float n5 = 3.01462978e-06 + mm * 3.42338708e-08 + e * 1.17733919e-07;
        float n = n0 + e * (n1 + e * (n2 + e * (n3 + e * (n4 + e * n5))));
        float odd = e * (1.0 / 6.0) + n;
        alpha = m < 1.4 ? m - (2.0 * excess + hidden * hidden)
                        : 1.0 - (1.0 - hidden) * (1.0 - hidden);
        alpha = m < 1.0e-37 ? 0.0 : alpha;
        back = 0.5 * alpha + (odd - hidden * odd);
    } else {
        float z = exp(-m);
        alpha = 1.0 - z;
        if (e >= 0.0) {
            float r = sqrt(e);
            back = psiRising(a, r) - z - z * psiRising(b, r);
        } else {
            back = psiFalling(a, -e) - (z + z * psiFalling(b, -e));
        }
    }
    // The factor is the largest float32 whose product with alpha cannot round above 2/3 alpha.
    back = clamp(back, 0.0, 0.66666662 * alpha);
    return vec3(alpha - back, back, alpha);
}
