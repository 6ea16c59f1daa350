// What a user's code reads of a volume: its layer's channel and others, around one place.
// Constants: kOtherChannels, how many others there are, at most 7; those of volume/raw_field.glsl.
// slotOf() is generated: 0 for the layer's channel, 1 for the first of the others, and so on.
#include "contract/user_code.glsl"
#include "volume/raw_field.glsl"

const int kMaxOtherChannels = 7;

layout(binding = kVoxelUnit) uniform sampler3D ownChannel;
layout(binding = kOtherChannelUnit) uniform sampler3D otherChannels[kMaxOtherChannels];

const int kAsNearest = 0;
const int kAsLinear = 1;
const int kAsLayer = 2;

vec3 sampleAt;  // grid coordinates

float read(sampler3D field, int how) {
    if (how == kAsNearest) return nearest(field, sampleAt);
    return how == kAsLinear ? trilinearAt(field, sampleAt) : fieldAt(field, sampleAt);
}

float readChannel(int channel, int how) {
    int slot = slotOf(channel);
    if (kOtherChannels > 0 && slot == 1) return read(otherChannels[0], how);
    if (kOtherChannels > 1 && slot == 2) return read(otherChannels[1], how);
    if (kOtherChannels > 2 && slot == 3) return read(otherChannels[2], how);
    if (kOtherChannels > 3 && slot == 4) return read(otherChannels[3], how);
    if (kOtherChannels > 4 && slot == 5) return read(otherChannels[4], how);
    if (kOtherChannels > 5 && slot == 6) return read(otherChannels[5], how);
    if (kOtherChannels > 6 && slot == 7) return read(otherChannels[6], how);
    return read(ownChannel, how);
}

float nearestValue(int channel) {
    return readChannel(channel, kAsNearest);
}

float interpolatedValue(int channel) {
    return readChannel(channel, kAsLinear);
}

float sampledValue(int channel) {
    return readChannel(channel, kAsLayer);
}
