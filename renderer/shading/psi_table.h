#pragma once

#include <vector>

namespace volcast::shading {

/// Entries along each axis of the table; the constant kPsiTableSide.
inline constexpr int kPsiTableSide = 256;

/// What shaders/lib/psi_table.glsl reads, kPsiTableSide^2 entries, u changing fastest.
///
/// In double by Gauss-Legendre quadrature, 1e-8 of an entry. Takes about a twentieth of a second.
/// Source: K. Moreland, E. Angel, A Fast High Accuracy Volume Renderer for Unstructured Data,
/// VolVis 2004, sections 3 and 5.
std::vector<float> makePsiTable();

/// w_b / alpha of a piece with optical depths `a` and `b` at its near and far end, >= 0; the limit
/// for thin pieces where both are 0.
double backShare(double a, double b);

}  // namespace volcast::shading
