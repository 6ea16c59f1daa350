#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "tests/support/numerics/psi_file.h"

namespace volcast::support {

// A weight may be off by kRelative times what is right plus kAbsolute: the depths below 1e-36 are
// where float32 loses its normal numbers and drivers flush them. The sum may be off by kSum.
inline constexpr double kRelative = 4e-6;
inline constexpr double kAbsolute = 1e-36;
inline constexpr double kSum = 0x1p-23;

/// The largest of one measure over a file, and where it was met.
struct Worst {
    const char* name = "";
    double limit = 0.0;      ///< Past it a row is counted.
    double error = -1.0;     ///< -1: no row took part.
    std::size_t past = 0;    ///< Rows past the limit.
    PsiRow row = {};         ///< With the largest error.
    glm::vec3 weights{0.0};  ///< Front, back, opacity there.
};

/// All measures of one row; the same indices as in WeightErrors::measures.
enum Measure {
    kFrontRelative,
    kBackRelative,
    kThin,            ///< Relative error of w_back where both depths are in [1e-6, 1].
    kMiddle,          ///< ... in [0, 10].
    kWide,            ///< Absolute error of w_back where both depths are in [1e-30, 1e6].
    kOpacity,         ///< |w_front + w_back - (1 - zeta)|
    kOwnSum,          ///< |w_front + w_back - alpha|, all three as computed.
    kNegative,        ///< How far a weight is below 0.
    kAboveTwoThirds,  ///< w_back - 2/3 alpha.
    kNotFinite,       ///< 1 where a weight is NaN or infinite.
    kMeasures
};

class WeightErrors {
public:
    WeightErrors();
    void add(const PsiRow& row, const glm::vec3& weights);

    [[nodiscard]] std::span<const Worst> measures() const { return measures_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] std::size_t rowsPast() const { return rowsPast_; }

private:
    std::array<Worst, kMeasures> measures_;
    std::size_t rows_ = 0, rowsPast_ = 0;
};

}  // namespace volcast::support
