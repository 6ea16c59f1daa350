// The field of a channel between its grid points, in grid coordinates.
// Constants: kTrilinear, kFilterInHardware.
#include "lib/layer.glsl"

layout(binding = kVoxelUnit) uniform sampler3D voxels;

float voxel(ivec3 point) {
    return texelFetch(voxels, point, 0).r;
}

// The value at grid coordinates `at`, trilinear or that of the nearest grid point.
float valueAt(vec3 at) {
    ivec3 last = ivec3(layer.grid.xyz) - 1;
    if (!kTrilinear) return voxel(clamp(ivec3(floor(at + 0.5)), ivec3(0), last));
    if (kFilterInHardware) return textureLod(voxels, (at + 0.5) / layer.grid.xyz, 0.0).r;
    ivec3 low = clamp(ivec3(floor(at)), ivec3(0), max(last - 1, ivec3(0)));
    ivec3 high = min(low + 1, last);
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 front = vec4(voxel(low), voxel(ivec3(high.x, low.yz)), voxel(ivec3(low.x, high.y, low.z)),
                      voxel(ivec3(high.xy, low.z)));
    vec4 back = vec4(voxel(ivec3(low.xy, high.z)), voxel(ivec3(high.x, low.y, high.z)),
                     voxel(ivec3(low.x, high.yz)), voxel(high));
    vec4 plane = mix(front, back, t.z);
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// Of any length but 0, without overflow.
vec3 scaled(vec3 v) {
    return v / max(max(abs(v.x), abs(v.y)), max(abs(v.z), 1.0e-37));
}

// The direction in which the field rises most, of length 1 in the world; 0 where it is flat. By
// central differences over a grid interval to each side; at a face of the box one side is shorter.
vec3 normalAt(vec3 at) {
    vec3 low = max(at - 1.0, vec3(0.0));
    vec3 high = min(at + 1.0, layer.grid.xyz - 1.0);
    vec3 above = vec3(valueAt(vec3(high.x, at.yz)), valueAt(vec3(at.x, high.y, at.z)),
                      valueAt(vec3(at.xy, high.z)));
    vec3 below = vec3(valueAt(vec3(low.x, at.yz)), valueAt(vec3(at.x, low.y, at.z)),
                      valueAt(vec3(at.xy, low.z)));
    // Quarters, because the difference of two large values may not be a number.
    vec3 slope = (0.25 * above - 0.25 * below) / max(high - low, vec3(0.5));
    vec3 normal = scaled(transpose(mat3(layer.gridFromData)) * scaled(slope));
    return normal == vec3(0.0) ? normal : normalize(normal);
}
