// How exactly does the texture unit interpolate? r: what it answers, g: what is right.
#include "shared/bindings.glsl"

layout(binding = kVoxelUnit) uniform sampler3D voxels;  // two voxels along x: 0 and 1

layout(location = 0) out vec4 answer;

void main() {
    float share = fract(gl_FragCoord.x * 0.6180339887);  // spread over [0, 1), none a multiple of 1/256
    answer = vec4(textureLod(voxels, vec3((share + 0.5) / 2.0, 0.5, 0.5), 0.0).r, share, 0.0, 1.0);
}
