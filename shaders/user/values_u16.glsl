// Data of unsigned integers of 16 bits, as a user's code sees them. Values between voxels keep their
// fraction, but for toRaw().
#include "contract/user_code.glsl"

struct useruint16_t {
    float uservalue;
};

uint toRaw(useruint16_t v) { return uint(v.uservalue + 0.5); }
float toNormalized(useruint16_t v) { return v.uservalue / 65535.0; }
float valueOf(useruint16_t v) { return v.uservalue; }

useruint16_t getDataValue(int channel) { return useruint16_t(nearestValue(channel)); }
useruint16_t getDataValue() { return getDataValue(kOwnChannel); }
useruint16_t getInterpolatedDataValue(int channel) { return useruint16_t(interpolatedValue(channel)); }
useruint16_t getInterpolatedDataValue() { return getInterpolatedDataValue(kOwnChannel); }
useruint16_t getSampledValue(int channel) { return useruint16_t(sampledValue(channel)); }
