#pragma once

#include <array>
#include <cstdint>

namespace volcast::load {

/// Durations in buckets of equal ratio: 64 to a factor of two, so that a quantile is at most
/// 1/64 (1.6 %) above the exact one. From 1 us to 2^42 us (50 days); constant size.
class Histogram {
public:
    void add(double ms);
    void merge(const Histogram& other);

    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    /// The smallest duration that at least `share` of all do not exceed, rounded up to its
    /// bucket's end; never above maxMs(). `share` in (0, 1]; 0 where there are none.
    [[nodiscard]] double quantileMs(double share) const;
    [[nodiscard]] double maxMs() const noexcept { return maxMs_; }
    [[nodiscard]] double meanMs() const noexcept;

private:
    static constexpr int kPerOctave = 64;
    static constexpr int kOctaves = 42;
    static std::size_t bucketOf(double us);

    std::array<std::uint32_t, std::size_t{kPerOctave} * kOctaves> buckets_{};
    std::uint64_t count_ = 0;
    double sumMs_ = 0;
    double maxMs_ = 0;
};

}  // namespace volcast::load
