// Makes the picture people see: linear premultiplied layers over the background, as sRGB with
// straight alpha.
// Source of the encoding: IEC 61966-2-1.
layout(binding = 0) uniform sampler2D layers;
layout(std140, binding = 0) uniform Background {
    vec4 background;  // linear, straight; a: opacity
};

layout(location = 0) out vec4 picture;

// A polynomial in the eighth root, minimax, right to 5e-7; pow() takes twice as long on llvmpipe.
vec3 srgbFrom(vec3 linear) {
    vec3 clamped = clamp(linear, 0.0, 1.0);
    vec3 root = sqrt(sqrt(sqrt(clamped)));
    vec3 curve = -0.0582148135 + root * (0.0328998305 + root * (-0.162824303 + root * (0.909053683 +
                 root * (0.313188702 + root * -0.0341032334))));
    return mix(curve, 12.92 * clamped, lessThanEqual(clamped, vec3(0.0031308)));
}

void main() {
    vec4 front = texelFetch(layers, ivec2(gl_FragCoord.xy), 0);
    float behind = (1.0 - front.a) * background.a;
    vec3 premultiplied = front.rgb + behind * background.rgb;
    // Straight alpha cannot say "light that hides nothing", which splats are: it needs the opacity
    // of its brightest channel.
    float brightest = max(premultiplied.r, max(premultiplied.g, premultiplied.b));
    float opacity = max(front.a + behind, min(brightest, 1.0));
    picture = vec4(srgbFrom(opacity > 0.0 ? premultiplied / opacity : vec3(0.0)), opacity);
}
