// The ray through a pixel, and where opaque layers end it.
// Constants: kEndsAtSurfaces (there are opaque layers that rays end at).
#include "contract/ray.glsl"
#include "lib/layer_uniforms.glsl"

// Distance to the nearest opaque surface of this pixel, from the ray's origin; huge where none is.
layout(binding = kOpaqueDistanceUnit) uniform sampler2D opaqueDistances;

// Position in the picture: x to the right, y upwards, both in [-1, 1]. Row 0 is the top.
vec2 pictureFrom(vec2 pixel) {
    vec2 share = pixel * layer.viewport.zw;
    return vec2(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y);
}

// The ray through `pixel` in window coordinates (pixel centres at .5).
Ray rayThrough(vec2 pixel) {
    vec2 at = pictureFrom(pixel);
    return Ray(layer.rayStart.xyz + at.x * layer.rayStartRight.xyz + at.y * layer.rayStartUp.xyz,
               normalize(layer.rayDirection.xyz + at.x * layer.rayDirectionRight.xyz +
                         at.y * layer.rayDirectionUp.xyz));
}

float opaqueDistance(vec2 pixel) {
    return kEndsAtSurfaces ? texelFetch(opaqueDistances, ivec2(pixel), 0).r : 3.0e38;
}
