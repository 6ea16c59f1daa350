// Data of floating point numbers, as a user's code sees them: as they are.
#include "contract/user_code.glsl"

float toRaw(float v) { return v; }
float toNormalized(float v) { return v; }
float valueOf(float v) { return v; }

float getDataValue(int channel) { return nearestValue(channel); }
float getDataValue() { return getDataValue(kOwnChannel); }
float getInterpolatedDataValue(int channel) { return interpolatedValue(channel); }
float getInterpolatedDataValue() { return getInterpolatedDataValue(kOwnChannel); }
float getSampledValue(int channel) { return sampledValue(channel); }
