// Data of unsigned integers of 8 bits, as a user's code sees them. Values between voxels keep their
// fraction, but for toRaw().
#include "contract/user_code.glsl"

struct useruint8_t {
    float uservalue;
};

uint toRaw(useruint8_t v) { return uint(v.uservalue + 0.5); }
float toNormalized(useruint8_t v) { return v.uservalue / 255.0; }
float valueOf(useruint8_t v) { return v.uservalue; }

useruint8_t getDataValue(int channel) { return useruint8_t(nearestValue(channel)); }
useruint8_t getDataValue() { return getDataValue(kOwnChannel); }
useruint8_t getInterpolatedDataValue(int channel) { return useruint8_t(interpolatedValue(channel)); }
useruint8_t getInterpolatedDataValue() { return getInterpolatedDataValue(kOwnChannel); }
useruint8_t getSampledValue(int channel) { return useruint8_t(sampledValue(channel)); }
