#include <algorithm>
#include <cmath>

#include "renderer/scene/map_texels.h"

namespace volcast::scene {
namespace {

using Values = std::vector<double>;

/// Integrals of a map from its first value on, at equally spaced values: of rho and of C rho.
struct Integrals {
    Values extinction;
    std::vector<glm::dvec3> emission;
};

/// int of rho and of C rho over [from, to], in which the map is linear: Simpson's rule is exact for
/// the product of two linear functions.
glm::dvec4 overLinearPiece(const data::TransferFunction& map, double from, double to) {
    // Limits from inside the piece: at a step both sides differ.
    const double margin = 1e-9 * (to - from);
    const auto at = [&map](double value) {
        return glm::dvec4{data::evaluate(map, static_cast<float>(value))};
    };
    const glm::dvec4 a = at(from + margin), b = at(0.5 * (from + to)), c = at(to - margin);
    const auto emitted = [](const glm::dvec4& m) { return glm::dvec3{m} * m.a; };
    const glm::dvec3 emission = (emitted(a) + 4.0 * emitted(b) + emitted(c)) / 6.0;
    return glm::dvec4{emission, (a.a + 4.0 * b.a + c.a) / 6.0} * (to - from);
}

Integrals integrate(const data::TransferFunction& map, const Values& at) {
    Integrals sums{.extinction = Values(at.size(), 0.0),
                   .emission = std::vector<glm::dvec3>(at.size(), glm::dvec3{0.0})};
    for (std::size_t i = 1; i < at.size(); ++i) {
        glm::dvec4 sum{0.0};
        double from = at[i - 1];
        for (const data::ControlPoint& point : map.points) {
            const double value = point.value;
            if (value <= from || value >= at[i]) continue;
            sum += overLinearPiece(map, from, value);
            from = value;
        }
        sum += overLinearPiece(map, from, at[i]);
        sums.extinction[i] = sums.extinction[i - 1] + sum.a;
        sums.emission[i] = sums.emission[i - 1] + glm::dvec3{sum};
    }
    return sums;
}

/// Opacity-weighted colour and extinction at one value.
glm::vec4 entryAt(const data::TransferFunction& map, double value) {
    return data::evaluate(map, static_cast<float>(value));
}

}  // namespace

std::vector<glm::vec4> preintegrated(const data::TransferFunction& map) {
    constexpr std::size_t kSide = kPreintegratedSide;
    const double low = map.points.front().value, high = map.points.back().value;
    Values at(kSide);
    for (std::size_t i = 0; i < kSide; ++i) {
        at[i] = low + (high - low) * static_cast<double>(i) / (kSide - 1);
    }
    std::vector<glm::vec4> table(kSide * kSide, entryAt(map, low));
    if (!(high > low)) return table;
    const Integrals sums = integrate(map, at);
    for (std::size_t back = 0; back < kSide; ++back) {
        for (std::size_t front = 0; front < kSide; ++front) {
            if (front == back) {
                table[back * kSide + front] = entryAt(map, at[back]);
                continue;
            }
            const std::size_t a = std::min(front, back), b = std::max(front, back);
            const double extinction = sums.extinction[b] - sums.extinction[a];
            const glm::dvec3 emission = sums.emission[b] - sums.emission[a];
            const glm::dvec3 colour = extinction > 0.0 ? emission / extinction : glm::dvec3{0.0};
            table[back * kSide + front] =
                glm::vec4{glm::dvec4{colour, std::max(extinction, 0.0) / (at[b] - at[a])}};
        }
    }
    return table;
}

}  // namespace volcast::scene
