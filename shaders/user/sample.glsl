// Calls the user's code for one sample.
#include "contract/user_code.glsl"

bool isNumber(float value) {
    return abs(value) <= 3.4e38;
}

// What the code says of the sample that the evaluator is at; colours that are no numbers are
// transparent. `value` is the intensity of code that names none.
Emission emissionAt(float value) {
    emission = Emission(vec4(0.0), value, false, 0.0, false);
    usermain();
    vec4 colour = emission.colour;
    bool numbers = isNumber(colour.r) && isNumber(colour.g) && isNumber(colour.b);
    emission.colour = numbers && colour.a > 0.0 ? vec4(colour.rgb, min(colour.a, 1.0)) : vec4(0.0);
    if (!emission.rated && emission.hasLooked) {
        emission.intensity = emission.looked;
        emission.rated = true;
    }
    return emission;
}
