#include "renderer/data/moments.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace volcast::data {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 14;

/// A mean, and the sum of squared distances from it.
class Sum {
public:
    /// `valueAt(i)` for i in [first, last): a mean first, then distances from it.
    template <class ValueAt>
    void add(std::size_t first, std::size_t last, const ValueAt& valueAt) {
        double sum = 0.0;
        std::uint64_t count = 0;
        for (std::size_t i = first; i < last; ++i) {
            const double value = valueAt(i);
            if (std::isnan(value)) continue;
            sum += value;
            ++count;
        }
        if (count == 0) return;
        const double mean = sum / static_cast<double>(count);
        double squares = 0.0;
        for (std::size_t i = first; i < last; ++i) {
            const double away = valueAt(i) - mean;
            if (!std::isnan(away)) squares += away * away;
        }
        join(count, mean, squares);
    }
    [[nodiscard]] Moments moments() const {
        const double variance = count_ > 0 ? squares_ / static_cast<double>(count_) : 0.0;
        return {.values = count_, .mean = mean_, .deviation = std::sqrt(variance)};
    }

private:
    void join(std::uint64_t count, double mean, double squares) {
        const auto mine = static_cast<double>(count_), other = static_cast<double>(count);
        const double apart = mean - mean_;
        const double share = other / (mine + other);
        mean_ += apart * share;
        squares_ += squares + apart * apart * mine * share;
        count_ += count;
    }
    std::uint64_t count_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
};

template <class ValueAt>
void addAll(Sum& sum, std::size_t count, const ValueAt& valueAt) {
    for (std::size_t first = 0; first < count; first += kBlock) {
        sum.add(first, std::min(count, first + kBlock), valueAt);
    }
}

template <class T>
Moments ofVoxels(std::span<const std::byte> voxels) {
    Sum sum;
    addAll(sum, voxels.size() / sizeof(T), [&](std::size_t i) {
        T value{};
        std::memcpy(&value, voxels.data() + i * sizeof(T), sizeof(T));
        return static_cast<double>(value);
    });
    return sum.moments();
}

Moments ofChannel(const Channel& channel, VoxelType type) {
    const auto voxels = channel.voxels.span();
    switch (type) {
        case VoxelType::kU8: return ofVoxels<std::uint8_t>(voxels);
        case VoxelType::kU16: return ofVoxels<std::uint16_t>(voxels);
        case VoxelType::kI16: return ofVoxels<std::int16_t>(voxels);
        case VoxelType::kF32: break;
    }
    return ofVoxels<float>(voxels);
}

Moments ofField(const Field& field) {
    Sum sum;
    for (const auto& step : field.steps) {
        addAll(sum, step.size(), [&](std::size_t i) { return static_cast<double>(step[i]); });
    }
    return sum.moments();
}

}  // namespace

std::vector<Moments> momentsOf(const Dataset& dataset) {
    std::vector<Moments> all;
    if (const Mesh* mesh = std::get_if<Mesh>(&dataset)) {
        for (const Field& field : mesh->fields) all.push_back(ofField(field));
        return all;
    }
    const auto& volume = std::get<Volume>(dataset);
    for (const Channel& channel : volume.channels) {
        all.push_back(ofChannel(channel, volume.type));
    }
    return all;
}

}  // namespace volcast::data
