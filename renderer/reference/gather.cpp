#include "renderer/reference/gather.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/segment_weights.h"

namespace volcast::reference {
namespace {

/// Exact at both ends, and where these are equal.
double between(double a, double b, double share) {
    return std::lerp(a, b, share);
}

/// Shares of a piece, 0 at its front.
struct Shares {
    double begin = 0.0, end = 1.0;
};

Shares within(const Piece& piece, const Span& span) {
    const double front = piece.front.distance, back = piece.back.distance;
    Shares shares;
    if (!(back > front)) return {1.0, 0.0};
    if (span.begin > front) shares.begin = (span.begin - front) / (back - front);
    if (span.end < back) shares.end = (span.end - front) / (back - front);
    return shares;
}

Shares within(const Piece& piece, const data::Range& interval) {
    const double f0 = piece.front.f, f1 = piece.back.f;
    const double min = interval.min, max = interval.max;
    if (std::max(f0, f1) < min || std::min(f0, f1) > max) return {1.0, 0.0};
    Shares shares;
    const double enter = f0 < f1 ? min : max, leave = f0 < f1 ? max : min;
    if (f0 < min || f0 > max) shares.begin = (enter - f0) / (f1 - f0);
    if (f1 < min || f1 > max) shares.end = (leave - f0) / (f1 - f0);
    return shares;
}

/// Calls `visit(from, to)`, shares of a part, for each stretch between neighbours in `bends`.
template <class Visit>
void forStretches(std::vector<double>& bends, const Visit& visit) {
    bends.push_back(0.0);
    bends.push_back(1.0);
    std::ranges::sort(bends);
    for (std::size_t i = 1; i < bends.size(); ++i) {
        if (bends[i] > bends[i - 1]) visit(bends[i - 1], bends[i]);
    }
}

/// A map over a stretch of a part in which it does not bend.
struct Ends {
    glm::dvec4 from, to;
};
Ends endsOf(const LinearMap& map, double v0, double v1, double from, double to) {
    const std::size_t piece = map.pieceAt(between(v0, v1, 0.5 * (from + to)));
    return {.from = map.on(piece, between(v0, v1, from)), .to = map.on(piece, between(v0, v1, to))};
}

/// The first of `levels` from f0 towards f1 by the half-open rule, or null.
const double* firstBetween(std::span<const double> levels, double f0, double f1) {
    // Taken are those in (f0, f1], or (f1, f0].
    const auto first = std::ranges::upper_bound(levels, std::min(f0, f1));
    const auto last = std::ranges::upper_bound(levels, std::max(f0, f1));
    if (first == last) return nullptr;
    return f0 < f1 ? &*first : &*(last - 1);
}

}  // namespace

void cut(std::span<const Piece> pieces, const Span& span,
         const std::optional<data::Range>& interval, std::vector<Part>& parts) {
    parts.clear();
    for (const Piece& piece : pieces) {
        Shares shares = within(piece, span);
        if (interval) {
            const Shares by = within(piece, *interval);
            shares = {std::max(shares.begin, by.begin), std::min(shares.end, by.end)};
        }
        if (!(shares.begin < shares.end)) continue;
        const Crossing &a = piece.front, &b = piece.back;
        const double length = (b.distance - a.distance) * (shares.end - shares.begin);
        if (!(length > 0.0)) continue;
        parts.push_back({.front = between(a.distance, b.distance, shares.begin),
                         .length = length,
                         .f0 = between(a.f, b.f, shares.begin),
                         .f1 = between(a.f, b.f, shares.end),
                         .g0 = between(a.g, b.g, shares.begin),
                         .g1 = between(a.g, b.g, shares.end),
                         .cell = piece.cell});
        if (!interval) continue;
        // What was cut at an end of the interval has exactly that value there.
        Part& part = parts.back();
        part.f0 = std::clamp<double>(part.f0, interval->min, interval->max);
        part.f1 = std::clamp<double>(part.f1, interval->min, interval->max);
    }
}

glm::dvec4 volume(std::span<const Part> parts, const Matter& matter, std::vector<double>& scratch) {
    constexpr double kNothingShows = 800.0;  // exp(-800) is 0.
    glm::dvec3 sum{0.0};
    double depth = 0.0;
    for (const Part& part : parts) {
        scratch.clear();
        matter.colour->addBends(part.f0, part.f1, scratch);
        matter.extinction->addBends(part.g0, part.g1, scratch);
        forStretches(scratch, [&](double from, double to) {
            const Ends colour = endsOf(*matter.colour, part.f0, part.f1, from, to);
            const Ends extinction = endsOf(*matter.extinction, part.g0, part.g1, from, to);
            const double length = part.length * (to - from);
            const SegmentWeights weights =
                segmentWeights(extinction.from.a * length, extinction.to.a * length);
            sum += std::exp(-depth) *
                   (weights.front * glm::dvec3{colour.from} + weights.back * glm::dvec3{colour.to});
            depth += weights.depth;
        });
        if (depth > kNothingShows) break;
    }
    return {sum, -std::expm1(-depth)};
}

double opticalDepth(std::span<const Part> parts, const LinearMap& extinction,
                    std::vector<double>& scratch) {
    double depth = 0.0;
    for (const Part& part : parts) {
        scratch.clear();
        extinction.addBends(part.g0, part.g1, scratch);
        forStretches(scratch, [&](double from, double to) {
            const Ends ends = endsOf(extinction, part.g0, part.g1, from, to);
            depth += 0.5 * (ends.from.a + ends.to.a) * (to - from) * part.length;
        });
    }
    return depth;
}

glm::dvec3 colourIntegral(std::span<const Part> parts, const LinearMap& colour,
                          std::vector<double>& scratch) {
    glm::dvec3 sum{0.0};
    for (const Part& part : parts) {
        scratch.clear();
        colour.addBends(part.f0, part.f1, scratch);
        forStretches(scratch, [&](double from, double to) {
            const Ends ends = endsOf(colour, part.f0, part.f1, from, to);
            sum += 0.5 * glm::dvec3{ends.from + ends.to} * ((to - from) * part.length);
        });
    }
    return sum;
}

std::optional<Extremes> extremes(std::span<const Part> parts) {
    if (parts.empty()) return std::nullopt;
    Extremes found;
    for (const Part& part : parts) {
        found.min = std::min({found.min, part.f0, part.f1});
        found.max = std::max({found.max, part.f0, part.f1});
    }
    return found;
}

std::optional<glm::dvec3> largestColour(std::span<const Part> parts, const LinearMap& colour) {
    if (parts.empty()) return std::nullopt;
    glm::dvec3 largest{-std::numeric_limits<double>::infinity()};
    for (const Part& part : parts) {
        const auto [low, high] = std::minmax(part.f0, part.f1);
        largest = glm::max(largest, glm::dvec3{colour.largest(low, high)});
    }
    return largest;
}

std::optional<LevelHit> firstLevel(std::span<const Piece> pieces, const Span& span,
                                   std::span<const double> levels) {
    std::optional<LevelHit> hit;
    for (const Piece& piece : pieces) {
        const Crossing &a = piece.front, &b = piece.back;
        // Pieces without a length count too: a level may fall between the faces of its neighbours.
        const double length = std::max(b.distance - a.distance, 0.0);
        const auto place = [&](double distance) {
            return length > 0.0 ? std::clamp((distance - a.distance) / length, 0.0, 1.0) : 0.0;
        };
        if (a.distance + length < span.begin || a.distance > span.end) continue;
        const double begin = span.begin > a.distance ? place(span.begin) : 0.0;
        const double end = span.end < a.distance + length ? place(span.end) : 1.0;
        const double f0 = begin > 0.0 ? between(a.f, b.f, begin) : a.f;
        const double f1 = end < 1.0 ? between(a.f, b.f, end) : b.f;
        if (hit) {
            hit->crossings += static_cast<int>((f0 < hit->level) != (f1 < hit->level));
            continue;
        }
        const double* level = firstBetween(levels, f0, f1);
        if (level == nullptr) continue;
        const double share = std::clamp((*level - a.f) / (b.f - a.f), 0.0, 1.0);
        hit = LevelHit{.distance = a.distance + length * share,
                       .level = *level,
                       .g = between(a.g, b.g, share),
                       .cell = piece.cell,
                       .crossings = 1};
    }
    return hit;
}

}  // namespace volcast::reference
