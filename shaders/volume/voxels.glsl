// The field of a channel between its grid points, in grid coordinates.
// Constants: kSampling, kFilterInHardware (trilinear by the texture unit).
#include "lib/layer.glsl"
#include "lib/unit.glsl"

layout(binding = kVoxelUnit) uniform sampler3D voxels;

const int kNearest = 0;
const int kTrilinear = 1;
const int kTricubic = 2;

float voxel(ivec3 point) {
    return texelFetch(voxels, point, 0).r;
}

ivec3 lastPoint() {
    return ivec3(layer.grid.xyz) - 1;
}

// The first grid point of the cell that holds `at`.
ivec3 cellAt(vec3 at) {
    return clamp(ivec3(floor(at)), ivec3(0), max(lastPoint() - 1, ivec3(0)));
}

float trilinear(vec3 at) {
    ivec3 low = cellAt(at);
    ivec3 high = min(low + 1, lastPoint());
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 front = vec4(voxel(low), voxel(ivec3(high.x, low.yz)), voxel(ivec3(low.x, high.y, low.z)),
                      voxel(ivec3(high.xy, low.z)));
    vec4 back = vec4(voxel(ivec3(low.xy, high.z)), voxel(ivec3(high.x, low.y, high.z)),
                     voxel(ivec3(low.x, high.yz)), voxel(high));
    vec4 plane = mix(front, back, t.z);
    vec2 line = mix(plane.xy, plane.zw, t.y);
    return mix(line.x, line.y, t.x);
}

// Weights of the grid points at -1, 0, 1 and 2 for the value at t in [0, 1]: Catmull-Rom, which
// keeps the values of grid points and reproduces quadratics. Beyond a face the value on it goes on.
// Source: R. Keys, Cubic Convolution Interpolation for Digital Image Processing, IEEE Transactions
// on Acoustics, Speech, and Signal Processing 29(6), 1981, with a = -1/2.
vec4 cubicWeights(float t) {
    return 0.5 * vec4(((2.0 - t) * t - 1.0) * t, (3.0 * t - 5.0) * t * t + 2.0,
                      ((4.0 - 3.0 * t) * t + 1.0) * t, (t - 1.0) * t * t);
}

// The grid points that tricubic interpolation reads along each axis.
struct Stencil {
    ivec4 x, y, z;
};

float cubicLine(Stencil points, vec4 weights, int y, int z) {
    return dot(weights, vec4(voxel(ivec3(points.x.x, y, z)), voxel(ivec3(points.x.y, y, z)),
                             voxel(ivec3(points.x.z, y, z)), voxel(ivec3(points.x.w, y, z))));
}

float cubicPlane(Stencil points, vec4 x, vec4 y, int z) {
    return dot(y, vec4(cubicLine(points, x, points.y.x, z), cubicLine(points, x, points.y.y, z),
                       cubicLine(points, x, points.y.z, z), cubicLine(points, x, points.y.w, z)));
}

// Written out: loops would soon meet the limit of llvmpipe.
float tricubic(vec3 at) {
    ivec3 low = cellAt(at);
    ivec3 last = lastPoint();
    ivec4 around = ivec4(-1, 0, 1, 2);
    Stencil points = Stencil(clamp(low.x + around, 0, last.x), clamp(low.y + around, 0, last.y),
                             clamp(low.z + around, 0, last.z));
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 x = cubicWeights(t.x), y = cubicWeights(t.y);
    return dot(cubicWeights(t.z),
               vec4(cubicPlane(points, x, y, points.z.x), cubicPlane(points, x, y, points.z.y),
                    cubicPlane(points, x, y, points.z.z), cubicPlane(points, x, y, points.z.w)));
}

// The value at grid coordinates `at`.
float valueAt(vec3 at) {
    if (kSampling == kNearest) return voxel(clamp(ivec3(floor(at + 0.5)), ivec3(0), lastPoint()));
    if (kSampling == kTricubic) return tricubic(at);
    return kFilterInHardware ? textureLod(voxels, (at + 0.5) / layer.grid.xyz, 0.0).r
                             : trilinear(at);
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
    return unit(transpose(mat3(layer.gridFromData)) * unit(slope));
}
