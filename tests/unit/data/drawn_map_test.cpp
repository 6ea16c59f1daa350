#include "renderer/data/drawn_map.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <boost/json/src.hpp>
#include <gtest/gtest.h>

namespace volcast::data {
namespace {

namespace json = boost::json;

json::array rows() {
    std::ifstream file{VOLCAST_SOURCE_DIR "/tests/support/maps/drawn_maps.json"};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    return json::parse(text).as_array();
}

double number(const json::value& list, std::size_t i) {
    return list.at(i).to_number<double>();
}

Window windowOf(const json::value& row) {
    return {.first = number(row.at("window"), 0), .last = number(row.at("window"), 1)};
}

DrawnMap drawnOf(const json::value& row) {
    DrawnMap map{.degree = row.at("degree").to_number<int>(),
                 .distance = row.at("distance").to_number<double>()};
    for (const json::value& p : row.at("colours").as_array()) {
        map.colours.push_back({number(p, 0), {number(p, 1), number(p, 2), number(p, 3)}});
    }
    for (const json::value& p : row.at("opacities").as_array()) {
        map.opacities.emplace_back(number(p, 0), number(p, 1));
    }
    return map;
}

Result<TransferFunction> resolvedOf(const json::value& row) {
    if (!row.as_object().contains("rgba")) return resolve(drawnOf(row), windowOf(row));
    std::vector<glm::dvec4> rgba;
    for (const json::value& e : row.at("rgba").as_array()) {
        rgba.emplace_back(number(e, 0), number(e, 1), number(e, 2), number(e, 3));
    }
    return fromTable(rgba, row.at("distance").to_number<double>(), windowOf(row));
}

double opacityOf(double extinction, double distance) {
    return -std::expm1(-extinction * distance);
}

TEST(DrawnMap, IsWhatTheRationalSplinesSay) {
    int count = 0;
    for (const json::value& row : rows()) {
        const std::string name{row.at("name").as_string()};
        const auto map = resolvedOf(row);
        ASSERT_TRUE(map) << name << ": " << map.error().message;
        EXPECT_LT(map->points.size(), 600U) << name;
        for (const json::value& expected : row.at("expected").as_array()) {
            const glm::vec4 found = evaluate(*map, static_cast<float>(number(expected, 0)));
            const double opacity = opacityOf(found.a, row.at("distance").to_number<double>());
            EXPECT_NEAR(opacity, number(expected, 1), kOpacityError)
                << name << " at " << number(expected, 0);
            for (int i = 0; i < 3; ++i) {
                // Slopes are at most 20 a window here, and float32 tells 6e-8 of its values apart.
                EXPECT_NEAR(found[i], number(expected, static_cast<std::size_t>(i) + 2), 1e-5)
                    << name << " at " << number(expected, 0);
            }
            ++count;
        }
    }
    EXPECT_GT(count, 300);
}

TEST(DrawnMap, IsAsCloseToTheCurveAsStatedEverywhere) {
    constexpr int kLooks = 20000;
    for (const json::value& row : rows()) {
        if (row.as_object().contains("rgba") || row.at("degree").to_number<int>() != 3) continue;
        DrawnMap drawn = drawnOf(row);
        const OpacityCurve curve{drawn.opacities, drawn.degree};
        drawn.distance = 1.0;
        const auto map = resolve(drawn, Window{});
        ASSERT_TRUE(map);
        for (int span = 0; span < curve.spans(); ++span) {
            const double begin = curve.joint(span).x, end = curve.joint(span + 1).x;
            for (int i = 1; i < kLooks / curve.spans(); ++i) {
                const double share = static_cast<double>(i) * curve.spans() / kLooks;
                const auto x = static_cast<float>(std::lerp(begin, end, share));
                if (x <= begin || x >= end) continue;
                const double found = opacityOf(evaluate(*map, x).a, 1.0);
                ASSERT_NEAR(found, curve.at(span, x), kOpacityError)
                    << row.at("name").as_string() << " at " << x;
            }
        }
    }
}

TEST(DrawnMap, KeepsColourPointsWhereTheyWereDrawn) {
    const DrawnMap map{.colours = {{0.0, {1, 0, 0}}, {0.3, {0, 1, 0}}, {1.0, {0, 0, 1}}},
                       .opacities = {{0.0, 0.2}, {1.0, 0.2}},
                       .distance = 2.0};
    const auto found = resolve(map, {.first = 0.0, .last = 10.0});
    ASSERT_TRUE(found);
    ASSERT_EQ(found->points.size(), 3U);
    EXPECT_FLOAT_EQ(found->points[1].value, 3.0F);
    EXPECT_EQ(found->points[1].colour, glm::vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(found->points[1].extinction, -std::log1p(-0.2F) / 2.0F);
}

TEST(DrawnMap, AnInvertedWindowIsTheMirroredMap) {
    const DrawnMap map{.colours = {{0.0, {1, 0, 0}}, {0.5, {1, 0, 0}}, {0.5, {0, 0, 1}}},
                       .opacities = {{0.0, 0.0}, {1.0, 0.5}},
                       .degree = 1};
    const auto forth = resolve(map, {.first = 0.0, .last = 8.0});
    const auto back = resolve(map, {.first = 8.0, .last = 0.0});
    ASSERT_TRUE(forth && back);
    for (const float value : {0.5F, 1.7F, 3.9F, 4.1F, 7.5F}) {
        EXPECT_NEAR(evaluate(*forth, value).a, evaluate(*back, 8.0F - value).a, 1e-6F);
        EXPECT_EQ(evaluate(*forth, value).b, evaluate(*back, 8.0F - value).b);
    }
}

TEST(DrawnMap, PositionsFollowTheAxis) {
    const DrawnMap map = linearMap({1, 1, 1}, 0.5, 1.0);
    const auto found = resolve(map, {.first = 1.0, .last = 10000.0},
                               {.along = [](double v) { return std::log10(v); },
                                .back = [](double p) { return std::pow(10.0, p); }});
    ASSERT_TRUE(found);
    for (const ControlPoint& point : found->points) {
        EXPECT_NEAR(opacityOf(point.extinction, 1.0), 0.5 * std::log10(point.value) / 4.0, 1e-6);
    }
    EXPECT_GT(found->points.size(), 2U);
}

TEST(DrawnMap, LinearFadesInFromBlack) {
    const auto map = resolve(linearMap({1.0F, 0.5F, 0.0F}, 0.8, 1.0), {.first = 2.0, .last = 4.0});
    ASSERT_TRUE(map);
    const glm::vec4 middle = evaluate(*map, 3.0F);
    EXPECT_NEAR(middle.r, 0.5F, 1e-6F);
    EXPECT_NEAR(middle.g, 0.25F, 1e-6F);
    EXPECT_NEAR(opacityOf(middle.a, 1.0), 0.4, kOpacityError);
    EXPECT_EQ(evaluate(*map, 1.0F), glm::vec4(0.0F));
    EXPECT_EQ(evaluate(*map, 5.0F), evaluate(*map, 4.0F));
}

TEST(DrawnMap, FullOpacityIsFiniteExtinction) {
    EXPECT_NEAR(extinctionOf(1.0, 1.0), 24.0 * std::log(2.0), 1e-9);
    EXPECT_NEAR(extinctionOf(0.5, 4.0), std::log(2.0) / 4.0, 1e-15);
    EXPECT_EQ(extinctionOf(0.0, 4.0), 0.0);
}

const DrawnMap kGood{.colours = {{0.0, {1, 1, 1}}}, .opacities = {{0.0, 0.0}, {1.0, 1.0}}};

std::string fieldAtFault(const DrawnMap& map, const Window& window = {}) {
    const auto resolved = resolve(map, window);
    if (resolved) return "none";
    // The sentence names the field, so that it can stand alone.
    EXPECT_NE(resolved.error().message.find(resolved.error().field), std::string::npos);
    return resolved.error().field;
}

TEST(DrawnMap, RefusalsNameWhatIsAtFault) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(fieldAtFault(kGood), "none");
    EXPECT_EQ(fieldAtFault(kGood, {.first = 3.0, .last = 3.0}), "window");
    EXPECT_EQ(fieldAtFault(kGood, {.first = 1e9, .last = 1e9 + 1}), "window");
    EXPECT_EQ(fieldAtFault(kGood, {.first = 0.0, .last = kNan}), "window");
    EXPECT_EQ(fieldAtFault(kGood, {.first = 0.0, .last = 1e300}), "window");
    DrawnMap map = kGood;
    map.colours.clear();
    EXPECT_EQ(fieldAtFault(map), "colours");
    map = kGood;
    map.opacities.clear();
    EXPECT_EQ(fieldAtFault(map), "opacities");
    map = kGood;
    map.opacities[1].y = 1.01;
    EXPECT_EQ(fieldAtFault(map), "opacities[1].opacity");
    map.opacities[1] = {kNan, 0.5};
    EXPECT_EQ(fieldAtFault(map), "opacities[1].position");
    map.opacities = {{0.5, 0.0}, {0.4, 0.0}};
    EXPECT_EQ(fieldAtFault(map), "opacities[1].position");
    map = kGood;
    map.colours[0].position = -0.1;
    EXPECT_EQ(fieldAtFault(map), "colours[0].position");
    map = kGood;
    map.colours[0].colour.g = -1.0F;
    EXPECT_EQ(fieldAtFault(map), "colours[0].colour");
    map = kGood;
    map.degree = 2;
    EXPECT_EQ(fieldAtFault(map), "degree");
    for (const double distance : {0.0, -1.0, kNan, kInfinity}) {
        map = kGood;
        map.distance = distance;
        EXPECT_EQ(fieldAtFault(map), "distance");
    }
    map = kGood;
    map.opacities.clear();
    for (int i = 0; i < 1200; ++i) map.opacities.emplace_back(i / 1200.0, i % 2);
    map.degree = 1;
    EXPECT_EQ(fieldAtFault(map), "opacities");
}

TEST(DrawnMap, TablesAtFaultAreNamedByTheirEntry) {
    const Window window{};
    std::vector<glm::dvec4> rgba(3, glm::dvec4{0.5});
    EXPECT_EQ(fromTable({}, 1.0, window).error().field, "rgba");
    EXPECT_EQ(fromTable(rgba, 0.0, window).error().field, "distance");
    EXPECT_EQ(fromTable(rgba, 1.0, {.first = 1.0, .last = 1.0}).error().field, "window");
    rgba[1].a = 2.0;
    EXPECT_EQ(fromTable(rgba, 1.0, window).error().field, "rgba[1]");
    rgba[1] = {-1.0, 0.0, 0.0, 0.0};
    EXPECT_EQ(fromTable(rgba, 1.0, window).error().field, "rgba[1]");
    rgba.assign(1025, glm::dvec4{0.5});
    const auto tooMany = fromTable(rgba, 1.0, window);
    EXPECT_EQ(tooMany.error().code, ErrorCode::kLimitExceeded);
}

}  // namespace
}  // namespace volcast::data
