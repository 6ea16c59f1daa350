#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/numerics/psi_file.h"

namespace volcast::support {

/// `count` pairs of depths each from T = log [1e-6, 1]^2, U = [0, 10]^2 and W = log [1e-30, 1e6]^2,
/// and `count` from the edges and the diagonals of these squares, where the worst errors are.
///
/// What is right for them is from renderer/reference, to 1e-13. `line` counts from 1.
std::vector<PsiRow> samplePsi(int count, std::uint64_t seed);

}  // namespace volcast::support
