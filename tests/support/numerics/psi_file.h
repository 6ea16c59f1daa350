#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::support {

/// One line of a file of weights: the depths, and what is right for them.
struct PsiRow {
    float a = 0.0F, b = 0.0F;  ///< tau_f_D, tau_b_D.
    double zeta = 1.0;         ///< exp(-(a + b)/2)
    double front = 0.0, back = 0.0;
    int line = 0;  ///< In the file, from 1.
};

/// Reads a CSV file whose first line names the columns tau_f_D, tau_b_D, zeta, w_front, w_back, in
/// any order; others are ignored.
///
/// Errors: kIo (it cannot be read), kInvalidArgument (a column missing, a number that is none, not
/// finite or negative, no rows), naming file and line.
Result<std::vector<PsiRow>> readPsiFile(const std::string& path);

}  // namespace volcast::support
