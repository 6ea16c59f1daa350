#include "server/load/histogram.h"

#include <algorithm>
#include <cmath>

namespace volcast::load {

// Within an octave the buckets are linear: the bits behind the leading one, as in HdrHistogram.
std::size_t Histogram::bucketOf(double us) {
    int exponent = 0;
    const double mantissa = std::frexp(std::max(us, 1.0), &exponent);  // [0.5, 1) * 2^exponent
    const int octave = std::min(exponent - 1, kOctaves - 1);
    const int within = std::min(static_cast<int>((mantissa * 2 - 1) * kPerOctave), kPerOctave - 1);
    const int bucket = octave * kPerOctave + within;
    return static_cast<std::size_t>(bucket);
}

void Histogram::add(double ms) {
    ++buckets_[bucketOf(ms * 1000.0)];
    ++count_;
    sumMs_ += ms;
    maxMs_ = std::max(maxMs_, ms);
}

void Histogram::merge(const Histogram& other) {
    for (std::size_t i = 0; i < buckets_.size(); ++i) buckets_[i] += other.buckets_[i];
    count_ += other.count_;
    sumMs_ += other.sumMs_;
    maxMs_ = std::max(maxMs_, other.maxMs_);
}

double Histogram::quantileMs(double share) const {
    const auto wanted =
        static_cast<std::uint64_t>(std::max(1.0, std::ceil(share * static_cast<double>(count_))));
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
        seen += buckets_[i];
        if (seen < wanted) continue;
        const auto octave = static_cast<int>(i) / kPerOctave;
        const auto within = static_cast<int>(i) % kPerOctave;
        const double end = std::ldexp(1.0 + (within + 1.0) / kPerOctave, octave);
        return std::min(end / 1000.0, maxMs_);
    }
    return 0;
}

double Histogram::meanMs() const noexcept {
    return count_ == 0 ? 0 : sumMs_ / static_cast<double>(count_);
}

}  // namespace volcast::load
