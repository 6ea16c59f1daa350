#include "renderer/reference/linear_map.h"

#include <algorithm>

namespace volcast::reference {

LinearMap::LinearMap(const data::TransferFunction& map, const scene::ScaleFunction& scale) {
    for (const data::ControlPoint& point : map.points) {
        values_.push_back(scale.ofPoint(point.value));
        matter_.emplace_back(point.colour, point.extinction);
    }
}

std::size_t LinearMap::pieceAt(double value) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(values_, value) - values_.begin());
}

glm::dvec4 LinearMap::on(std::size_t piece, double value) const {
    if (piece == 0) return matter_.front();
    if (piece == values_.size()) return matter_.back();
    const double low = values_[piece - 1], high = values_[piece];
    if (!(high > low)) return matter_[piece];
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return matter_[piece - 1] * (1.0 - share) + matter_[piece] * share;
}

LinearMap::Line LinearMap::lineOf(std::size_t piece) const {
    if (piece == 0) return {.offset = matter_.front()};
    if (piece == values_.size()) return {.offset = matter_.back()};
    const double low = values_[piece - 1], high = values_[piece];
    if (!(high > low)) return {.offset = matter_[piece]};
    const glm::dvec4 slope = (matter_[piece] - matter_[piece - 1]) / (high - low);
    return {.slope = slope, .offset = matter_[piece - 1] - low * slope};
}

void LinearMap::addBends(double from, double to, std::vector<double>& shares) const {
    const double low = std::min(from, to), high = std::max(from, to);
    for (auto k = std::ranges::upper_bound(values_, low); k != values_.end() && *k < high; ++k) {
        shares.push_back(std::clamp((*k - from) / (to - from), 0.0, 1.0));
    }
}

glm::dvec4 LinearMap::largest(double low, double high) const {
    glm::dvec4 largest = glm::max(at(low), at(high));
    // What a step at `low` comes from is not met on the way up from there.
    for (auto k = std::ranges::upper_bound(values_, low); k != values_.end() && *k <= high; ++k) {
        largest = glm::max(largest, matter_[static_cast<std::size_t>(k - values_.begin())]);
    }
    return largest;
}

}  // namespace volcast::reference
