// What a user's code reads of a volume around one place, and the pieces it is asked for: samples alone.
#include "contract/user_code.glsl"

const int kAsNearest = 0;
const int kAsLinear = 1;
const int kAsLayer = 2;

vec3 sampleAt;  // grid coordinates

#include "volume/user_channels.glsl"

float nearestValue(int channel) {
    return readChannel(channel, kAsNearest);
}

float interpolatedValue(int channel) {
    return readChannel(channel, kAsLinear);
}

float sampledValue(int channel) {
    return readChannel(channel, kAsLayer);
}

float sampleExtent(float extent) {
    return extent;
}

float placeSample(float value, float distance) {
    return value;
}
