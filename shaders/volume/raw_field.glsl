// Fields of a volume between their grid points, in grid coordinates, each in a texture of its own
// with its values as they are: what a user's code reads.
// Constants: kSampling, kFilterInHardware (trilinear by the texture unit).
#include "lib/layer.glsl"

const int kNearest = 0;
const int kTrilinear = 1;
const int kTricubic = 2;

float voxel(sampler3D field, ivec3 point) {
    return texelFetch(field, point, 0).r;
}

ivec3 lastPoint() {
    return ivec3(layer.grid.xyz) - 1;
}

// The first grid point of the cell that holds `at`.
ivec3 cellAt(vec3 at) {
    return clamp(ivec3(floor(at)), ivec3(0), max(lastPoint() - 1, ivec3(0)));
}

float trilinear(sampler3D field, vec3 at) {
    ivec3 low = cellAt(at);
    ivec3 high = min(low + 1, lastPoint());
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 front = vec4(voxel(field, low), voxel(field, ivec3(high.x, low.yz)),
                      voxel(field, ivec3(low.x, high.y, low.z)), voxel(field, ivec3(high.xy, low.z)));
    vec4 back = vec4(voxel(field, ivec3(low.xy, high.z)), voxel(field, ivec3(high.x, low.y, high.z)),
                     voxel(field, ivec3(low.x, high.yz)), voxel(field, high));
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

float cubicLine(sampler3D field, Stencil points, vec4 weights, int y, int z) {
    return dot(weights,
               vec4(voxel(field, ivec3(points.x.x, y, z)), voxel(field, ivec3(points.x.y, y, z)),
                    voxel(field, ivec3(points.x.z, y, z)), voxel(field, ivec3(points.x.w, y, z))));
}

float cubicPlane(sampler3D field, Stencil points, vec4 x, vec4 y, int z) {
    return dot(y, vec4(cubicLine(field, points, x, points.y.x, z),
                       cubicLine(field, points, x, points.y.y, z),
                       cubicLine(field, points, x, points.y.z, z),
                       cubicLine(field, points, x, points.y.w, z)));
}

// Written out: loops would soon meet the limit of llvmpipe.
float tricubic(sampler3D field, vec3 at) {
    ivec3 low = cellAt(at);
    ivec3 last = lastPoint();
    ivec4 around = ivec4(-1, 0, 1, 2);
    Stencil points = Stencil(clamp(low.x + around, 0, last.x), clamp(low.y + around, 0, last.y),
                             clamp(low.z + around, 0, last.z));
    vec3 t = clamp(at - vec3(low), 0.0, 1.0);
    vec4 x = cubicWeights(t.x), y = cubicWeights(t.y);
    return dot(cubicWeights(t.z),
               vec4(cubicPlane(field, points, x, y, points.z.x),
                    cubicPlane(field, points, x, y, points.z.y),
                    cubicPlane(field, points, x, y, points.z.z),
                    cubicPlane(field, points, x, y, points.z.w)));
}

float trilinearAt(sampler3D field, vec3 at) {
    return kFilterInHardware ? textureLod(field, (at + 0.5) / layer.grid.xyz, 0.0).r
                             : trilinear(field, at);
}

float nearest(sampler3D field, vec3 at) {
    return voxel(field, clamp(ivec3(floor(at + 0.5)), ivec3(0), lastPoint()));
}

// The value of a field at grid coordinates `at`, as the layer samples.
float fieldAt(sampler3D field, vec3 at) {
    if (kSampling == kNearest) return nearest(field, at);
    return kSampling == kTricubic ? tricubic(field, at) : trilinearAt(field, at);
}
