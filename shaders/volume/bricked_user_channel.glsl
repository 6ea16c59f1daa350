// The layer's channel as a user's code reads it at `sampleAt`, from bricks: the same function as in
// volume/user_channels.glsl.
#include "volume/bricked_voxels.glsl"

float readChannel(int channel, int how) {
    vec3 at = clamp(sampleAt, vec3(0.0), vec3(gridLast));
    turnTo(at);
    if (kMissing && page.range.x > page.range.y) return noValue();
    int sampling = how == kAsNearest ? kNearest : how == kAsLinear ? kTrilinear : kSampling;
    // The code is given values as they are stored.
    return valueInPage(levelFromGrid(at), sampling) + page.shift;
}
