// Data of integers of 16 bits, as a user's code sees them. Values between voxels keep their
// fraction, but for toRaw().
#include "contract/user_code.glsl"

struct userint16_t {
    float uservalue;
};

int toRaw(userint16_t v) { return int(floor(v.uservalue + 0.5)); }
float toNormalized(userint16_t v) { return max(v.uservalue / 32767.0, -1.0); }
float valueOf(userint16_t v) { return v.uservalue; }

userint16_t getDataValue(int channel) { return userint16_t(nearestValue(channel)); }
userint16_t getDataValue() { return getDataValue(kOwnChannel); }
userint16_t getInterpolatedDataValue(int channel) { return userint16_t(interpolatedValue(channel)); }
userint16_t getInterpolatedDataValue() { return getInterpolatedDataValue(kOwnChannel); }
userint16_t getSampledValue(int channel) { return userint16_t(sampledValue(channel)); }
