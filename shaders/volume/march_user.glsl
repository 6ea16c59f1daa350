// Marches through a voxel volume, by the steps of volume/steps.glsl, and asks a user's code in the middle
// of each. Nobody knows what the code shows of a value; but where the layer's own channel has no value, or
// none in the interval, it is not asked, and such space is passed over.
// Constants: kEarlyStop; kInterval: only values in an interval count; those of volume/steps.glsl and
// volume/user_voxels.glsl.
// Uses: model.
#include "volume/missing.glsl"
#include "volume/steps.glsl"
#include "volume/user_voxels.glsl"

layout(location = 0) out vec4 colour;

bool takeStep(inout RayState state, March march, int i) {
    sampleAt = positionAt(march, distanceOf(march, float(i) + 0.5));
    float value = sampledValue(kOwnChannel);
    if (lacksValue(value)) return false;
    float inInterval = value - codeHeader.y;  // as the layer's block has it
    if (kInterval && !(inInterval >= layer.gather.z && inInterval <= layer.gather.w)) return false;
    Segment piece = Segment(value, value, value, value, march.dt, distanceOf(march, float(i)));
    return stepRay(state, piece) && kEarlyStop;
}

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    March march;
    meetsBox(ray, windowOf(ray, gl_FragCoord.xy), march);
    RayState state = beginRay(ray);
    int together = stepsTogether(march);
    int i = march.first;
    bool finished = false;
    if (i < march.steps) {
        do {
            int beyond = march.steps;
            bool shows = true;
            if (kByDistance) {
                do {
                    int empty = emptySteps(march, float(i) + 0.5, true);
                    shows = empty == 0;
                    beyond = min(i + (shows ? together : empty), march.steps);
                    i = shows ? i : beyond;
                } while (!shows && i < march.steps);
            }
            if (shows) {
                do {
                    finished = takeStep(state, march, i);
                    ++i;
                } while (i < beyond && !finished);
            }
        } while (i < march.steps && !finished);
    }
    colour = endRay(state, 1.0);
}
