#include "tests/support/numerics/psi_samples.h"

#include <cmath>
#include <random>

#include "renderer/reference/segment_weights.h"

namespace volcast::support {

std::vector<PsiRow> samplePsi(int count, std::uint64_t seed) {
    std::mt19937_64 random{seed};
    // Not std::uniform_real_distribution: what that gives depends on the library.
    const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const auto thin = [&] { return std::pow(1e-6, uniform()); };
    const auto middle = [&] { return 10.0 * uniform(); };
    const auto wide = [&] { return 1e6 * std::pow(1e-36, uniform()); };

    std::vector<PsiRow> rows;
    const auto add = [&](double near, double far) {
        PsiRow row{.a = static_cast<float>(near), .b = static_cast<float>(far)};
        const auto weights = reference::segmentWeights(row.a, row.b);
        row.zeta = std::exp(-weights.depth);
        row.front = weights.front;
        row.back = weights.back;
        row.line = static_cast<int>(rows.size()) + 1;
        rows.push_back(row);
    };
    // In this order by every compiler.
    const auto addPair = [&](const auto& depth) {
        const double near = depth();
        add(near, depth());
    };
    const auto addEdges = [&](double depth, double low, double high) {
        add(depth, low);
        add(low, depth);
        add(depth, high);
        add(high, depth);
        add(depth, depth);
    };
    for (int i = 0; i < count; ++i) {
        addPair(thin);
        addPair(middle);
        addPair(wide);
        // 1e-6F and 1e-30F are below 1e-6 and 1e-30.
        if (i % 15 == 0) addEdges(thin(), std::nextafter(1e-6F, 1.0F), 1.0);
        if (i % 15 == 5) addEdges(middle(), 0.0, 10.0);
        if (i % 15 == 10) addEdges(wide(), std::nextafter(1e-30F, 1.0F), 1e6);
    }
    return rows;
}

}  // namespace volcast::support
