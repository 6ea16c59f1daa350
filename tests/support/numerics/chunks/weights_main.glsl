// Weights of one pair of depths a pixel, by the weightsOf() of the file that includes this one.
// depths: texels (a, b). The answer: front weight, back weight, opacity.
layout(binding = 5) uniform samplerBuffer depths;
layout(location = 0) out vec4 weights;

const int kRow = 1024;  // pairs in a row of pixels

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int pair = at.y * kRow + at.x;
    vec2 ab = texelFetch(depths, min(pair, textureSize(depths) - 1)).xy;
    weights = vec4(weightsOf(ab.x, ab.y), 1.0);
}
