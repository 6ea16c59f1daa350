// Random segments through random piecewise linear maps: the exact integrators against the
// reference, and against themselves where the segments are split.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "renderer/reference/gather.h"
#include "tests/support/gl_test.h"
#include "tests/support/numerics/segments_probe.h"

namespace volcast {
namespace {

using data::TransferFunction;
using support::must;
using support::ProbedAnswer;
using support::ProbedModel;
using support::ProbedRay;
using support::ProbedSegment;

constexpr double kRound = 0x1p-24;  // What one float32 operation is off by, relatively.

class Random {
public:
    explicit Random(std::uint64_t seed) : bits_{seed} {}
    /// In [0, 1). Not std::uniform_real_distribution: what that gives depends on the library.
    double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    double logarithmic(double low, double high) { return low * std::pow(high / low, uniform()); }
    bool chance(double share) { return uniform() < share; }
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(uniform() * static_cast<double>(count));
    }

private:
    std::mt19937_64 bits_;
};

/// Counts for every way in which the shader finds a value; steps, stretches without extinction.
TransferFunction randomMap(Random& random) {
    constexpr std::array<std::size_t, 8> kCounts{1, 2, 4, 6, 8, 12, 40, 300};
    const std::size_t count = kCounts[random.below(kCounts.size())];
    const bool uneven = random.chance(0.5);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(uneven ? random.logarithmic(1e-4, 1.0) : random.uniform());
    }
    std::ranges::sort(values);
    const bool steps = random.chance(0.3);
    TransferFunction map;
    for (std::size_t i = 0; i < count; ++i) {
        const bool step = steps && i > 0 && random.chance(0.3);
        const auto channel = [&] { return static_cast<float>(random.uniform()); };
        const bool empty = random.chance(0.3);
        map.points.push_back(
            {.value = step ? map.points.back().value : static_cast<float>(values[i]),
             .colour = {channel(), channel(), channel()},
             .extinction = empty ? 0.0F : static_cast<float>(random.logarithmic(1e-3, 1.0))});
    }
    return map;
}

bool isStep(const TransferFunction& map, float value) {
    return std::ranges::count(map.points, value, &data::ControlPoint::value) > 1;
}

/// Thin to deep; also of one value, of values that hardly differ, between control points. None ends
/// at a step: which side of it then counts is agreed on, no integral.
ProbedSegment randomSegment(Random& random, const TransferFunction& map) {
    const auto value = [&] {
        const float point = map.points[random.below(map.points.size())].value;
        if (random.chance(0.2) && !isStep(map, point)) return point;
        return static_cast<float>(random.chance(0.5) ? random.uniform(-0.2, 1.2)
                                                     : random.logarithmic(1e-5, 1.0));
    };
    ProbedSegment segment{.front = value(), .back = value()};
    if (random.chance(0.1)) segment.back = segment.front;
    if (random.chance(0.1)) segment.back = segment.front * 1.00001F;
    segment.extent = static_cast<float>(random.logarithmic(1e-6, 100.0));
    return segment;
}

ProbedRay split(Random& random, const ProbedSegment& segment) {
    std::vector<double> shares{0.0, 1.0};
    const std::size_t cuts = 1 + random.below(5);
    for (std::size_t i = 0; i < cuts; ++i) shares.push_back(random.uniform());
    std::ranges::sort(shares);
    ProbedRay ray;
    float front = segment.front;
    for (std::size_t i = 1; i < shares.size(); ++i) {
        const double share = shares[i];
        const bool last = i + 1 == shares.size();
        const auto back =
            last ? segment.back
                 : static_cast<float>(std::lerp(static_cast<double>(segment.front),
                                                static_cast<double>(segment.back), share));
        const double length = (share - shares[i - 1]) * segment.extent;
        ray.push_back({.front = front,
                       .back = back,
                       .extent = static_cast<float>(length),
                       .goesOn = i > 1 && random.chance(0.7)});
        front = back;
    }
    return ray;
}

/// How a map may be off by a rounded value: its largest entries, steepest slopes and its steps
/// between two values. x: of red, green and blue; y: of extinction.
struct Shape {
    glm::dvec2 largest{0.0}, slope{0.0}, steps{0.0};
};
Shape shapeOf(const TransferFunction& map, double low, double high) {
    const auto entries = [](const data::ControlPoint& p) {
        return glm::dvec4{p.colour, p.extinction};
    };
    const auto both = [](const glm::dvec4& v) {
        return glm::dvec2{std::max({v.r, v.g, v.b}), v.a};
    };
    Shape shape;
    for (const auto& point : map.points) {
        shape.largest = glm::max(shape.largest, both(entries(point)));
    }
    for (std::size_t i = 1; i < map.points.size(); ++i) {
        const auto &from = map.points[i - 1], &to = map.points[i];
        if (to.value < low || from.value > high) continue;
        const glm::dvec2 rise = both(glm::abs(entries(to) - entries(from)));
        const double run = static_cast<double>(to.value) - static_cast<double>(from.value);
        if (run > 0.0) shape.slope = glm::max(shape.slope, rise / run);
        if (run == 0.0) shape.steps += rise;
    }
    return shape;
}

/// What float32 may change of a segment, taken in `parts` parts.
///
/// Maps give entries that are off by 18 roundings of the largest: a sum of 8 terms of rounded
/// factors; what is looked up has fewer. Values at ends of parts are off by 4 roundings of the
/// larger value, a mix and its share, and one of the distance for each part, as lengths add up; at
/// a step that moves the place of the step. Weights are off by 5e-7 (shaders/README.md), 9
/// roundings, and the sum over parts by 3 for each part.
struct Bound {
    glm::dvec2 entry, line;  ///< Of entries, and of their integrals; x: colour, y: extinction.
    double opacity, light;

    Bound(const Shape& shape, const ProbedSegment& s, double parts, double alpha) {
        const double larger = std::max(std::abs(s.front), std::abs(s.back));
        const double distance = std::abs(static_cast<double>(s.back) - s.front);
        const double value = kRound * (4.0 * larger + parts * distance);
        const double moved = distance > value ? value / distance : 1.0;
        entry = 18.0 * kRound * shape.largest + value * shape.slope;
        line = static_cast<double>(s.extent) *
               (entry + moved * shape.steps + 2.0 * parts * kRound * shape.largest);
        const double weights = (9.0 + 3.0 * parts) * kRound * alpha;
        opacity = weights + line.y;
        const double step = std::min(alpha, moved * s.extent * shape.largest.y);
        light = shape.largest.x * opacity + alpha * entry.x + step * shape.steps.x;
    }
};

struct Case {
    scene::MapContent content;
    reference::LinearMap colour, extinction;
    std::vector<ProbedSegment> segments;
    std::vector<ProbedRay> whole, split;

    [[nodiscard]] Shape shape(const ProbedSegment& s) const {
        // A value that is rounded may be in the next piece.
        const double margin = 1e-6;
        const double low = std::min(s.front, s.back) - margin;
        const double high = std::max(s.front, s.back) + margin;
        Shape shape = shapeOf(content.map, low, high);
        if (content.densityMap.points.empty()) return shape;
        const Shape second = shapeOf(content.densityMap, low, high);
        shape.largest.y = second.largest.y;
        shape.slope.y = second.slope.y;
        shape.steps.y = second.steps.y;
        return shape;
    }
};

reference::Part partOf(const ProbedSegment& s) {
    return {.front = 0.0,
            .length = s.extent,
            .f0 = s.front,
            .f1 = s.back,
            .g0 = s.front,
            .g1 = s.back,
            .cell = 0};
}

class SegmentProperties : public support::GlTest {
protected:
    static constexpr int kMaps = 60;
    static constexpr int kSegments = 100;

    static Case randomCase(std::uint64_t seed) {
        static const scene::ScaleFunction kIdentity{{}, {.min = 0.0F, .max = 1.0F}};
        Random random{seed};
        Case made;
        made.content.map = randomMap(random);
        made.content.largestColours = true;
        if (random.chance(0.3)) made.content.densityMap = randomMap(random);
        const bool second = !made.content.densityMap.points.empty();
        made.colour = {made.content.map, kIdentity};
        made.extinction = {second ? made.content.densityMap : made.content.map, kIdentity};
        for (int i = 0; i < kSegments; ++i) {
            const ProbedSegment segment = randomSegment(random, made.content.map);
            made.segments.push_back(segment);
            made.whole.push_back({segment});
            made.split.push_back(split(random, segment));
        }
        return made;
    }

    /// Calls `check(case, segment, whole, split)` with the answers for each segment of each case.
    template <class Check>
    static void forAll(const ProbedModel& model, const Check& check) {
        support::SegmentsProbe probe{device()};
        for (std::uint64_t seed = 1; seed <= kMaps; ++seed) {
            const Case made = randomCase(seed);
            const auto whole = must(probe(model, made.content, made.whole));
            const auto parts = must(probe(model, made.content, made.split));
            for (std::size_t i = 0; i < made.segments.size(); ++i) {
                const ProbedSegment& s = made.segments[i];
                SCOPED_TRACE(testing::Message() << "map " << seed << ", " << s.front << " to "
                                                << s.back << " over " << s.extent);
                check(made, s, whole[i], parts[i]);
            }
        }
    }
    static void expectNear(const glm::vec3& got, const glm::dvec3& right, double bound) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], right[c], bound) << "channel " << c;
    }
};

// A ray is finished at an opacity of 1 - 1e-6, so that much may be missing.
TEST_F(SegmentProperties, VolumesAreExactAndMayBeSplit) {
    constexpr double kFinished = 1e-6;
    std::vector<double> scratch;
    forAll({.segment = "exact", .model = "volume"}, [&](const Case& made, const ProbedSegment& s,
                                                        const ProbedAnswer& whole,
                                                        const ProbedAnswer& split) {
        const glm::dvec4 right = reference::volume(
            {{partOf(s)}}, {.colour = &made.colour, .extinction = &made.extinction}, scratch);
        const double missing = right.a > 1.0 - 2.0 * kFinished ? 2.0 * kFinished : 0.0;
        const Bound one{made.shape(s), s, static_cast<double>(whole.parts), right.a};
        const Bound many{made.shape(s), s, static_cast<double>(split.parts), right.a};
        EXPECT_NEAR(whole.colour.a, right.a, one.opacity + missing);
        expectNear(whole.colour, right, one.light + missing);
        EXPECT_NEAR(split.colour.a, whole.colour.a, one.opacity + many.opacity + missing);
        expectNear(split.colour, whole.colour, one.light + many.light + missing);
    });
}

// exp() is off by at most 4 roundings of 1.
TEST_F(SegmentProperties, XraysAreExactAndMayBeSplit) {
    std::vector<double> scratch;
    forAll({.segment = "line_exact", .model = "xray"},
           [&](const Case& made, const ProbedSegment& s, const ProbedAnswer& whole,
               const ProbedAnswer& split) {
               const double right =
                   std::exp(-reference::opticalDepth({{partOf(s)}}, made.extinction, scratch));
               const auto bound = [&](const ProbedAnswer& answer) {
                   const Bound of{made.shape(s), s, static_cast<double>(answer.parts), 1.0};
                   return right * std::expm1(of.line.y) + 4.0 * kRound;
               };
               EXPECT_NEAR(whole.colour.r, right, bound(whole));
               EXPECT_NEAR(split.colour.r, whole.colour.r, bound(whole) + bound(split));
           });
}

TEST_F(SegmentProperties, SplatsAreExactAndMayBeSplit) {
    std::vector<double> scratch;
    forAll({.segment = "line_exact", .model = "splat"},
           [&](const Case& made, const ProbedSegment& s, const ProbedAnswer& whole,
               const ProbedAnswer& split) {
               const glm::dvec3 right =
                   reference::colourIntegral({{partOf(s)}}, made.colour, scratch);
               const auto bound = [&](const ProbedAnswer& answer) {
                   return Bound{made.shape(s), s, static_cast<double>(answer.parts), 1.0}.line.x;
               };
               expectNear(whole.colour, right, bound(whole));
               expectNear(split.colour, whole.colour, bound(whole) + bound(split));
           });
}

// Only values at both ends are computed; those between are what the map holds.
TEST_F(SegmentProperties, LargestColoursAreExactAndMayBeSplit) {
    forAll({.segment = "largest_exact", .model = "mip_colour"},
           [&](const Case& made, const ProbedSegment& s, const ProbedAnswer& whole,
               const ProbedAnswer& split) {
               const auto right = reference::largestColour({{partOf(s)}}, made.colour);
               const double bound = 18.0 * kRound * made.shape(s).largest.x;
               expectNear(whole.colour, *right, bound);
               expectNear(split.colour, whole.colour, bound);
           });
}

}  // namespace
}  // namespace volcast
