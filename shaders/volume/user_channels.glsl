// A volume's channels as a user's code reads them at `sampleAt`: its layer's own and others.
// Constants: kOtherChannels, how many others there are, at most 7; those of volume/raw_field.glsl.
// slotOf() is generated: 0 for the layer's channel, 1 for the first of the others, and so on.
#include "volume/raw_field.glsl"

const int kMaxOtherChannels = 7;

layout(binding = kVoxelUnit) uniform sampler3D ownChannel;
layout(binding = kOtherChannelUnit) uniform sampler3D otherChannels[kMaxOtherChannels];

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
