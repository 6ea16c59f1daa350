// Controls of a user's code, and the functions by which it answers. The state of a control is a few
// texels, so that a change is an upload.
// Layout of the buffer (texels of 4 floats), written by renderer/scene/user_texels.cpp:
//   texel 0                x: reference distances a world unit, times e^gain; y: what the layer's
//                          interval has been shifted by
//   texel 1 + i, control i slider, select   x: its number; of int and uint: the number's bits
//                          color            rgb, linear
//                          invlerp          x: begin of the range, y: 1 / its length
//                          transferFunction x: begin of the window, y: 1 / its length,
//                                           z: number of points, w: texel of the first
//   points, 2 texels each  colour (linear) and opacity; x: value, y: 1 / distance to the next point
#include "shared/bindings.glsl"
#include "contract/user_code.glsl"

layout(binding = kMapUnit) uniform samplerBuffer userTexels;

vec4 codeHeader = texelFetch(userTexels, 0);

vec4 controlTexel(int control) {
    return texelFetch(userTexels, 1 + control);
}

void looked(float at) {
    emission.looked = clamp(at, 0.0, 1.0);
    emission.hasLooked = true;
}

float invLerp(vec4 control, bool clamps, float value) {
    float at = (value - control.x) * control.y;
    looked(at);
    return clamps ? clamp(at, 0.0, 1.0) : at;
}

// Halves [range.x, range.y], which holds the number of points that are not above `value`. No loop,
// because llvmpipe ends all loops of an invocation after 65,535 iterations in total.
ivec2 halved(int first, ivec2 range, float value) {
    int middle = (range.x + range.y + 1) >> 1;
    return value >= texelFetch(userTexels, first + 2 * middle - 1).x
               ? ivec2(middle, range.y)
               : ivec2(range.x, max(middle - 1, range.x));
}

vec4 transferFunctionAt(vec4 control, float value) {
    looked((value - control.x) * control.y);
    int first = int(control.w);
    int count = int(control.z);
    if (count == 0 || !(value >= texelFetch(userTexels, first + 1).x)) return vec4(0.0);
    // At least one of at most 256 points is not above the value: 8 halvings find how many.
    ivec2 range = ivec2(1, count);
    range = halved(first, halved(first, halved(first, range, value), value), value);
    range = halved(first, halved(first, halved(first, range, value), value), value);
    range = halved(first, halved(first, range, value), value);
    int point = first + 2 * (range.x - 1);
    vec4 begin = texelFetch(userTexels, point);
    if (range.x == count) return begin;
    vec4 place = texelFetch(userTexels, point + 1);
    return mix(begin, texelFetch(userTexels, point + 2), (value - place.x) * place.y);
}

void emitRGBA(vec4 colour) { emission.colour = colour; }
void emitRGB(vec3 colour) { emission.colour = vec4(colour, 1.0); }
void emitGrayscale(float value) { emission.colour = vec4(value); }
void emitIntensity(float intensity) {
    emission.intensity = intensity;
    emission.rated = true;
}
void emitTransparent() {
    emission.colour = vec4(0.0);
    emitIntensity(0.0);
}
