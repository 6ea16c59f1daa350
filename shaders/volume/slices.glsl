// One slice: each pixel's share is that of a piece of its ray as long as slices are apart along it,
// with the value on the slice. Shares of slices are blended, lib/finish_shares.glsl ends the rays.
// Constants: kInterval: only values in an interval count; kShaded: samples are by layer.light; those of
// lib/window.glsl and volume/voxels.glsl.
// Uses: classify through the model; segment through the model; model.
#include "lib/light.glsl"
#include "lib/window.glsl"
#include "volume/slice_block.glsl"
#include "volume/voxels.glsl"

layout(location = 0) flat in float planeDistance;

layout(location = 0) out vec4 share;

void main() {
    if (gl_HelperInvocation) return;
    Ray ray = rayThrough(gl_FragCoord.xy);
    float rise = dot(ray.direction, layer.rayDirection.xyz);
    float at = planeDistance / rise;
    Window window = windowOf(ray, gl_FragCoord.xy);
    vec3 position = (layer.gridFromData * vec4(ray.origin + at * ray.direction, 1.0)).xyz;
    float value = valueAt(clamp(position, vec3(0.0), layer.grid.xyz - 1.0));
    bool counts = at >= window.begin && at <= window.end;
    if (kInterval) counts = counts && value >= layer.gather.z && value <= layer.gather.w;
    if (!counts || lacksValue(value)) discard;
    float extent = slices.planes.y / rise;
    if (kShaded && matterAt(value, value).a > 0.0) {
        pieceLight = lightOn(normalAt(position), ray.origin + at * ray.direction, -ray.direction);
    }
    Segment piece = Segment(value, value, value, value, extent, at - 0.5 * extent);
    RayState state = beginRay(ray);
    enterData(state, piece);
    stepRay(state, piece);
    share = packRay(state);
}
