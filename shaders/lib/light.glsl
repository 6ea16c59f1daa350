// What a point light adds to the colour of matter that reflects it about a normal, on both sides
// alike: C (ambient + diffuse |n.l|) + specular |n.h|^exponent, h halfway between light and eye.
// Source: J. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977.
// Constants: kLightAtEye: the light has no place of its own.
#include "lib/layer_uniforms.glsl"
#include "lib/unit.glsl"

// On the piece in hand; x: factor of its colour, y: white. Set by the evaluator.
vec2 pieceLight = vec2(1.0, 0.0);

// Computed before any loop, because llvmpipe reads a uniform again in each round: see
// classify/transfer_function.glsl.
vec3 lightPlace = layer.light.xyz + max(-gl_FragCoord.x, 0.0);
vec4 reflection = layer.reflection + max(-gl_FragCoord.x, 0.0);

// `normal`: of length 1, or 0 where there is none: no highlight, else as if it faced the light.
vec2 lightOn(vec3 normal, vec3 position, vec3 towardsEye) {
    vec3 towardsLight = kLightAtEye ? towardsEye : unit(lightPlace - position);
    float lit = normal == vec3(0.0) ? 1.0 : abs(dot(normal, towardsLight));
    vec3 halfway = kLightAtEye ? towardsEye : unit(towardsLight + towardsEye);
    float shine = min(abs(dot(normal, halfway)), 1.0);
    return vec2(reflection.x + reflection.y * lit, reflection.z * pow(shine, reflection.w));
}
