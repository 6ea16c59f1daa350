// The share of one piece with linear colour and linear extinction, from a table: returns (h, alpha),
// so that the piece adds alpha ((1 - h) front + h back). a, b: optical depths of its near and its
// far end, >= 0.
//
// The table holds h over u = sqrt(m)/(1 + sqrt(m)) along rows and v = sqrt(b)/(sqrt(a) + sqrt(b))
// from row to row, m = (a + b)/2, kPsiTableSide entries each; made by renderer/shading/psi_table.cpp.
// Constants: kPsiTableSide.
#include "lib/opacity.glsl"
#include "shared/bindings.glsl"

layout(binding = kPsiTableUnit) uniform samplerBuffer psiTable;

float psiEntry(ivec2 at) {
    return texelFetch(psiTable, at.y * kPsiTableSide + at.x).r;
}

vec2 psiFromTable(float a, float b) {
    float m = 0.5 * a + 0.5 * b;
    float root = sqrt(m);
    float both = sqrt(a) + sqrt(b);
    vec2 at = vec2(root / (1.0 + root), both > 0.0 ? sqrt(b) / both : 0.5) *
              float(kPsiTableSide - 1);
    ivec2 low = min(ivec2(at), kPsiTableSide - 2);
    vec2 t = at - vec2(low);
    float h = mix(mix(psiEntry(low), psiEntry(low + ivec2(1, 0)), t.x),
                  mix(psiEntry(low + ivec2(0, 1)), psiEntry(low + ivec2(1, 1)), t.x), t.y);
    return vec2(h, opacityOf(m));
}
