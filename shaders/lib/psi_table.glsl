// The share of one piece with linear colour and linear extinction, from a table: returns
// (h, alpha), so that the piece adds alpha ((1 - h) front + h back). a, b: optical depths of its
// near and its far end, >= 0; above 1e24 they count as 1e24.
//
// A deep piece shows what is near its front, to a depth of about 1: h goes to 1/a, or where a = 0
// to sqrt(pi/(2 b)), and in between h a depends on a/sqrt(b) alone. So with p, which is b where
// that is small and 2 sqrt(b) where it is large, the table holds
//     h (c + a + p)  over  u = (a + p)/(c + a + p) along rows and v = p/(a + p) from row to row,
// c = kPsiTableMiddle, kPsiTableSide entries each, made by renderer/shading/psi_table.cpp. That is
// smooth and between 1 and 3.5 up to u = 1, infinite depth.
// Constants: kPsiTableSide.
#include "lib/opacity.glsl"
#include "shared/bindings.glsl"
#include "shared/psi_table.glsl"

layout(binding = kPsiTableUnit) uniform samplerBuffer psiTable;

float psiEntry(ivec2 at) {
    return texelFetch(psiTable, at.y * kPsiTableSide + at.x).r;
}

vec2 psiFromTable(float a, float b) {
    a = min(a, 1.0e24);
    b = min(b, 1.0e24);
    // p = 2 b/root; sums are kept times root, for two divisions instead of four.
    float root = 1.0 + sqrt(1.0 + b);
    float sum = a * root + 2.0 * b;
    float scale = 1.0 / (kPsiTableMiddle * root + sum);
    vec2 at = vec2(sum * scale, 2.0 * b / max(sum, 1.0e-37)) * float(kPsiTableSide - 1);
    ivec2 low = min(ivec2(at), kPsiTableSide - 2);
    vec2 t = at - vec2(low);
    float h = mix(mix(psiEntry(low), psiEntry(low + ivec2(1, 0)), t.x),
                  mix(psiEntry(low + ivec2(0, 1)), psiEntry(low + ivec2(1, 1)), t.x), t.y);
    // The factor is the largest float32 whose product with alpha cannot round above 2/3 alpha.
    return vec2(min(h * (root * scale), 0.66666662), opacityOf(0.5 * a + 0.5 * b));
}
