// Rays that march until something opaque ends them; among opaque layers the nearest shows.
// Uses: model.
#include "volume/march_ray.glsl"
#include "lib/depth.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

void main() {
    if (gl_HelperInvocation) return;
    colour = castRay(gl_FragCoord.xy, distanceOut);
    if (distanceOut >= kNoHit) discard;
    gl_FragDepth = depthAt(rayThrough(gl_FragCoord.xy), distanceOut);
}
