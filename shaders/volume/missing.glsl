// Voxels without a value are NaN, and so is all that is interpolated from one: nothing is there.
// Constants: kMissing: there are such voxels.

float noValue() {
    return uintBitsToFloat(0x7fc00000u);
}

bool lacksValue(float value) {
    return kMissing && isnan(value);
}

// Central differences about `at` use its own value for neighbours that have none.
void standIn(inout vec3 places, inout vec3 values, vec3 at, float own) {
    bvec3 none = isnan(values);
    places = mix(places, at, none);
    values = mix(values, vec3(own), none);
}
