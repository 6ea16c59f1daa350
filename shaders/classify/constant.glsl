// The same matter everywhere; for tests in closed form.
// Constants: kColour0, kColour1, kColour2, kExtinction.
vec4 classify(float value) {
    return vec4(kColour0, kColour1, kColour2, kExtinction);
}

bool transparentBetween(float lo, float hi) {
    return kExtinction == 0.0;
}
