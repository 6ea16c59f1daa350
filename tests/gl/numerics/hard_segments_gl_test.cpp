// The rows of hard_cases.csv that are about single segments, through the chunks of the ray models.
#include <cmath>

#include "tests/support/gl_test.h"
#include "tests/support/numerics/hard_cases.h"
#include "tests/support/numerics/segments_probe.h"

namespace volcast {
namespace {

using support::after;
using support::allowed;
using support::must;
using support::Row;
using support::rowsOf;

/// `count` segments of `extent` each; all go from f0 to f1, so each is entered anew.
struct OneRay {
    float f0, f1, extent;
    int count = 1;
};

/// The points "(x,y)(x,y)..." after `key`.
std::vector<glm::dvec2> pointsAfter(const std::string& text, const std::string& key) {
    std::vector<glm::dvec2> points;
    const char* at = text.c_str() + text.find(key) + key.size();
    while (*at == '(') {
        char* end = nullptr;
        const double x = std::strtod(at + 1, &end);
        const double y = std::strtod(end + 1, &end);
        points.emplace_back(x, y);
        at = end + 1;
    }
    return points;
}

double valueAt(const std::vector<glm::dvec2>& points, double x) {
    std::size_t i = 1;
    while (i + 1 < points.size() && x > points[i].x) ++i;
    const auto& a = points[i - 1];
    const auto& b = points[i];
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

data::TransferFunction mapOf(const std::vector<glm::dvec2>& colours,
                             const std::vector<glm::dvec2>& extinctions) {
    data::TransferFunction map;
    for (const glm::dvec2& p : colours.size() > extinctions.size() ? colours : extinctions) {
        map.points.push_back({.value = static_cast<float>(p.x),
                              .colour = glm::vec3{static_cast<float>(valueAt(colours, p.x))},
                              .extinction = static_cast<float>(valueAt(extinctions, p.x))});
    }
    return map;
}

class HardSegments : public support::GlTest {
protected:
    static support::ProbedAnswer cast(const std::string& integrator, const std::string& model,
                                      const scene::MapContent& content, const OneRay& ray) {
        const support::ProbedSegment segment{.front = ray.f0, .back = ray.f1, .extent = ray.extent};
        const std::vector<support::ProbedRay> rays{
            support::ProbedRay(static_cast<std::size_t>(ray.count), segment)};
        support::SegmentsProbe probe{device()};
        return must(probe({.segment = integrator, .model = model}, content, rays)).at(0);
    }
    static float number(const std::string& text, const std::string& key) {
        return static_cast<float>(after(text, key));
    }
};

TEST_F(HardSegments, VolumeIsSplitAtControlPoints) {
    const auto rows = rowsOf("absorption-emission");
    ASSERT_EQ(rows.size(), 6U);
    for (const Row& row : rows) {
        const auto map = mapOf(pointsAfter(row[2], "colour cps "), pointsAfter(row[2], "tau cps "));
        const auto got = cast("exact", "volume", {.map = map},
                              {number(row[1], "f0="), number(row[1], "f1="), number(row[1], "D=")});
        EXPECT_NEAR(got.colour.r, after(row[3], "I="), 1e-5) << row[1];
        EXPECT_NEAR(got.colour.a, after(row[3], "alpha="), 1e-5) << row[1];
    }
}

TEST_F(HardSegments, LargestColours) {
    const auto rows = rowsOf("mip");
    ASSERT_EQ(rows.size(), 5U);
    std::vector<glm::dvec2> points;
    for (const Row& row : rows) {
        if (!row[2].starts_with("same")) points = pointsAfter(row[2], "g cps ");
        const bool flat = row[2].find("f0=f1=") != std::string::npos;
        const float f0 = number(row[2], flat ? "f0=f1=" : "f0=");
        const float f1 = number(row[2], flat ? "f0=f1=" : "f1=");
        const auto got = cast("largest_exact", "mip_colour",
                              {.map = mapOf(points, points), .largestColours = true}, {f0, f1, 1});
        const double tolerance = row[4] == "exact" ? 0.0 : std::stod(row[4]);
        EXPECT_NEAR(got.colour.r, std::stod(row[3]), tolerance) << row[1];
    }
}

TEST_F(HardSegments, IntegralsOfSplatAndXray) {
    const auto splats = rowsOf("splat");
    const auto xrays = rowsOf("x-ray");
    ASSERT_EQ(splats.size(), 6U);
    ASSERT_EQ(xrays.size(), 6U);
    const auto points = pointsAfter(splats[0][2], "C cps ");
    const scene::MapContent content{.map = mapOf(points, points)};
    for (const Row& row : splats) {
        const double right = std::stod(row[3]);
        const auto got = cast("line_exact", "splat", content,
                              {number(row[1], "f0="), number(row[1], "f1="), 1.0F});
        EXPECT_NEAR(got.colour.r, right, allowed(row[4], right)) << row[1];
    }
    for (const Row& row : xrays) {
        const double right = after(row[3], "mean)=");
        const auto got = cast("line_exact", "xray", content,
                              {number(row[1], "f0="), number(row[1], "f1="), number(row[1], "D=")});
        EXPECT_NEAR(got.colour.r, right, allowed(row[4], right)) << row[1];
    }
}

TEST_F(HardSegments, LevelsOfIsosurfaces) {
    const auto rows = rowsOf("isosurface");
    ASSERT_EQ(rows.size(), 7U);
    for (const Row& row : rows) {
        scene::MapContent content{.map = {{{.value = 0.0F}}}};
        const bool list = row[1].find("iso={") != std::string::npos;
        content.levels = {{.value = number(row[1], "iso=")}};
        if (list) content.levels = {{.value = 0.3F}, {.value = 0.5F}, {.value = 0.8F}};
        const auto got =
            cast("", "isosurface", content, {number(row[1], "f0="), number(row[1], "f1="), 1.0F});
        const bool none = row[3].find("NO hit") != std::string::npos || row[3].starts_with("no");
        EXPECT_EQ(got.colour.a, none ? 0.0F : 1.0F) << row[1];
        if (none) continue;
        EXPECT_NEAR(got.hitDistance, after(row[3], list ? "1/7=" : "t="), 1e-6) << row[1];
    }
}

TEST_F(HardSegments, LayersAccumulate) {
    const auto rows = rowsOf("accumulate");
    ASSERT_EQ(rows.size(), 6U);
    for (const Row& row : rows) {
        const auto count = static_cast<int>(after(row[1], "N="));
        const auto depth = number(row[1], "optical depth ");
        const data::TransferFunction map{
            {{.value = 0.0F, .colour = glm::vec3{1.0F}, .extinction = depth}}};
        const auto got = cast("exact", "volume", {.map = map},
                              {0.0F, 0.0F, 1.0F / static_cast<float>(count), count});
        EXPECT_NEAR(got.colour.a, after(row[3], "alpha="), 1e-5) << row[1];
        EXPECT_NEAR(got.colour.r, got.colour.a, 1e-5) << row[1];
    }
}

}  // namespace
}  // namespace volcast
