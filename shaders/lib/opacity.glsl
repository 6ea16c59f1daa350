// Opacity of an optical depth, 1 - exp(-depth), for depth >= 0.
//
// exp() alone loses thin depths: 1 - exp(-1e-8) is 0 in float32. Below 1/4 a polynomial of
// (1 - exp(-x)) / x keeps the relative error near rounding.
float opacityOf(float depth) {
    float series = depth * (1.0 - depth * (1.0 / 2.0) * (1.0 - depth * (1.0 / 3.0) *
                   (1.0 - depth * (1.0 / 4.0) * (1.0 - depth * (1.0 / 5.0) *
                   (1.0 - depth * (1.0 / 6.0) * (1.0 - depth * (1.0 / 7.0)))))));
    return depth < 0.25 ? series : 1.0 - exp(-depth);
}
