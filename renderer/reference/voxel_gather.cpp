#include "renderer/reference/voxel_gather.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/gauss_legendre.h"

namespace volcast::reference {
namespace {

/// Pieces count as joined that are closer than rounding can part them.
bool goesOn(const VoxelPiece& before, const VoxelPiece& piece) {
    constexpr double kTouch = 1e-9;  // Of a distance: far above rounding, far below what shows.
    return piece.front <= before.front + before.length + kTouch * std::abs(piece.front);
}

void addCrossingsOf(const Bernstein& f, std::span<const double> values,
                    std::vector<double>& places) {
    const Bounds bounds = hull(f);
    for (auto v = std::ranges::lower_bound(values, bounds.low);
         v != values.end() && *v <= bounds.high; ++v) {
        addCrossings(f, *v, places);
    }
}

VoxelPiece partOf(const VoxelPiece& piece, double from, double to) {
    return {.front = piece.front + from * piece.length,
            .length = (to - from) * piece.length,
            .f = piece.f.over(from, to)};
}

/// Calls `visit(part)` for each part of a piece between places where f takes one of `values`.
template <class Visit>
void forParts(const VoxelPiece& piece, std::span<const double> values, const Visit& visit) {
    std::vector<double> places;
    addCrossingsOf(piece.f, values, places);
    if (places.empty()) return visit(piece);
    places.push_back(1.0);
    std::ranges::sort(places);
    double from = 0.0;
    for (const double to : places) {
        if (to > from) visit(partOf(piece, from, to));
        from = std::max(from, to);
    }
}

LinearMap::Line lineOn(const LinearMap& map, const Bernstein& f) {
    return map.lineOf(map.pieceAt(f.at(0.5)));
}

/// The sum of `share(t)` over [from, to] by Gauss points, halved until it stays the same.
template <class Share>
glm::dvec3 integral(const Share& share, double from, double to, double tolerance, int halvings) {
    static const GaussRule<10> kRule = gaussLegendre<10>();
    const auto rule = [&](double a, double b) {
        glm::dvec3 sum{0.0};
        for (std::size_t i = 0; i < kRule.node.size(); ++i) {
            sum += kRule.weight[i] * share(a + (b - a) * kRule.node[i]);
        }
        return (b - a) * sum;
    };
    const auto refined = [&](const auto& self, double a, double b, const glm::dvec3& whole,
                             int left) -> glm::dvec3 {
        const double middle = 0.5 * (a + b);
        const glm::dvec3 front = rule(a, middle), back = rule(middle, b);
        const glm::dvec3 off = glm::abs(front + back - whole);
        if (std::max({off.x, off.y, off.z}) <= tolerance || left == 0) return front + back;
        return self(self, a, middle, front, left - 1) + self(self, middle, b, back, left - 1);
    };
    return refined(refined, from, to, rule(from, to), halvings);
}

/// One part in which both maps are linear, as volume() sums it.
class VolumeSum {
public:
    VolumeSum(const Matter& matter, const LightAt& light) : matter_{matter}, light_{light} {}

    void add(const VoxelPiece& part) {
        const LinearMap::Line colour = lineOn(*matter_.colour, part.f);
        const LinearMap::Line line = lineOn(*matter_.extinction, part.f);
        const Bernstein extinction =
            part.f.linear(part.length * line.slope.a, part.length * line.offset.a);
        const Bernstein depth = extinction.antiderivative();
        if (!(depth.back() > 0.0)) return;
        const auto share = [&](double t) {
            glm::dvec3 emitted = glm::dvec3(colour.slope * part.f.at(t) + colour.offset);
            if (light_) {
                const glm::dvec2 lit = light_(part.front + t * part.length);
                emitted = emitted * lit.x + lit.y;
            }
            return emitted * (extinction.at(t) * std::exp(-depth.at(t)));
        };
        std::vector<double> ends;
        for (double level = 1.0; level < std::min(depth.back(), kNothingShows); ++level) {
            addCrossings(depth, level, ends);
        }
        if (depth.back() < kNothingShows) ends.push_back(1.0);
        double from = 0.0;
        for (const double to : ends) {
            sum_ += std::exp(-depth_) * (light_ ? integral(share, from, to, 1e-9, 12)
                                                : integral(share, from, to, 1e-12, 30));
            from = to;
        }
        depth_ += depth.back();
    }
    [[nodiscard]] bool finished() const { return depth_ > kNothingShows; }
    [[nodiscard]] glm::dvec4 result() const { return {sum_, -std::expm1(-depth_)}; }

private:
    static constexpr double kNothingShows = 60.0;
    const Matter& matter_;
    const LightAt& light_;
    glm::dvec3 sum_{0.0};
    double depth_ = 0.0;
};

std::vector<double> bendsOf(const Matter& matter) {
    std::vector<double> bends = matter.colour->values();
    const std::vector<double>& more = matter.extinction->values();
    bends.insert(bends.end(), more.begin(), more.end());
    std::ranges::sort(bends);
    bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
    return bends;
}

/// int of a map along the pieces: a polynomial's integral is its coefficients' mean.
glm::dvec4 lineIntegral(std::span<const VoxelPiece> pieces, const LinearMap& map) {
    glm::dvec4 sum{0.0};
    for (const VoxelPiece& piece : pieces) {
        forParts(piece, map.values(), [&](const VoxelPiece& part) {
            const LinearMap::Line line = lineOn(map, part.f);
            sum += part.length * (part.f.mean() * line.slope + line.offset);
        });
    }
    return sum;
}

bool below(double value, double level) {
    return value < level;
}

/// The level that is met first on the way from a to b in one step, or null.
const double* firstBetween(std::span<const double> levels, double a, double b) {
    const auto first = std::ranges::upper_bound(levels, std::min(a, b));
    const auto last = std::ranges::upper_bound(levels, std::max(a, b));
    if (first == last) return nullptr;
    return a < b ? &*first : &*(last - 1);
}

/// The first place in a piece where it crosses any level, and the level; else null.
const double* firstWithin(const Bernstein& f, std::span<const double> levels, double& place) {
    const double* found = nullptr;
    const Bounds bounds = hull(f);
    std::vector<double> places;
    for (auto level = std::ranges::lower_bound(levels, bounds.low);
         level != levels.end() && *level <= bounds.high; ++level) {
        places.clear();
        addCrossings(f, *level, places);
        if (places.empty() || (found != nullptr && places.front() >= place)) continue;
        place = places.front();
        found = &*level;
    }
    return found;
}

}  // namespace

void cutVoxels(const std::optional<data::Range>& interval, std::vector<VoxelPiece>& pieces) {
    if (!interval) return;
    const std::array<double, 2> ends{interval->min, interval->max};
    std::vector<VoxelPiece> kept;
    for (const VoxelPiece& piece : pieces) {
        forParts(piece, ends, [&](const VoxelPiece& part) {
            const double middle = part.f.at(0.5);
            if (middle >= ends[0] && middle <= ends[1]) kept.push_back(part);
        });
    }
    pieces = std::move(kept);
}

glm::dvec4 volume(std::span<const VoxelPiece> pieces, const Matter& matter, const LightAt& light) {
    VolumeSum sum{matter, light};
    const std::vector<double> bends = bendsOf(matter);
    for (const VoxelPiece& piece : pieces) {
        forParts(piece, bends, [&](const VoxelPiece& part) { sum.add(part); });
        if (sum.finished()) break;
    }
    return sum.result();
}

double opticalDepth(std::span<const VoxelPiece> pieces, const LinearMap& extinction) {
    return lineIntegral(pieces, extinction).a;
}

glm::dvec3 colourIntegral(std::span<const VoxelPiece> pieces, const LinearMap& colour) {
    return {lineIntegral(pieces, colour)};
}

std::optional<Extremes> extremes(std::span<const VoxelPiece> pieces) {
    if (pieces.empty()) return std::nullopt;
    Extremes found;
    for (const VoxelPiece& piece : pieces) {
        const Bounds outer = hull(piece.f);
        if (outer.low >= found.min && outer.high <= found.max) continue;
        const Bounds own = range(piece.f);
        found = {std::min(found.min, own.low), std::max(found.max, own.high)};
    }
    return found;
}

std::optional<glm::dvec3> largestColour(std::span<const VoxelPiece> pieces,
                                        const LinearMap& colour) {
    if (pieces.empty()) return std::nullopt;
    glm::dvec3 largest{-std::numeric_limits<double>::infinity()};
    for (const VoxelPiece& piece : pieces) {
        const Bounds own = range(piece.f);
        largest = glm::max(largest, glm::dvec3(colour.largest(own.low, own.high)));
    }
    return largest;
}

std::uint64_t entries(std::span<const VoxelPiece> pieces) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        count += i == 0 || !goesOn(pieces[i - 1], pieces[i]) ? 1U : 0U;
    }
    return count;
}

std::optional<LevelHit> firstLevel(std::span<const VoxelPiece> pieces,
                                   std::span<const double> levels) {
    std::optional<LevelHit> hit;
    std::vector<double> places;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const VoxelPiece& piece = pieces[i];
        const bool joined = i > 0 && goesOn(pieces[i - 1], piece);
        const double before = joined ? pieces[i - 1].f.back() : piece.f.front();
        if (!hit) {
            double place = 0.0;
            const double* level = firstBetween(levels, before, piece.f.front());
            if (level == nullptr) level = firstWithin(piece.f, levels, place);
            if (level == nullptr) continue;
            const double distance = piece.front + place * piece.length;
            hit = LevelHit{.distance = distance, .level = *level, .g = *level};
        }
        const bool jumps = below(before, hit->level) != below(piece.f.front(), hit->level);
        places.clear();
        addCrossings(piece.f, hit->level, places);
        hit->crossings += static_cast<int>(places.size()) + (jumps ? 1 : 0);
    }
    return hit;
}

}  // namespace volcast::reference
