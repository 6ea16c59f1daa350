#include "server/commands/map_file.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace volcast::commands {
namespace {

const MapUsual kUsual{.window = {.min = 10.0F, .max = 20.0F}, .distance = 2.0};

data::TransferFunction read(const std::string& text, const MapUsual& usual = kUsual) {
    auto map = parseMap(text, usual);
    EXPECT_TRUE(map) << text << ": " << map.error().message;
    return map ? *map : data::TransferFunction{};
}

double opacity(const data::TransferFunction& map, float value, double distance) {
    return -std::expm1(-static_cast<double>(data::evaluate(map, value).a) * distance);
}

TEST(MapFile, LinesAreStillRead) {
    EXPECT_EQ(read("0 1 0 0 5\n1 0 1 0 6\n").points.size(), 2U);
}

TEST(MapFile, PointsAreThoseOfASceneDocument) {
    const auto map =
        read(R"( {"points": [{"colour": {"r": 1}}, {"value": 2, "extinction": 0.5}]})");
    ASSERT_EQ(map.points.size(), 2U);
    EXPECT_EQ(map.points[0].colour, glm::vec3(1, 0, 0));
    EXPECT_EQ(map.points[1].value, 2.0F);
    EXPECT_EQ(map.points[1].extinction, 0.5F);
}

TEST(MapFile, ColoursAndOpacitiesAreDrawnApart) {
    const auto map = read(R"({"colours": [[0, "#000000"], [0.5, [0, 1, 0]], [1, "#FF8000"]],
                              "opacities": [[0, 0.2], [1, 0.6]], "curve": "lines"})");
    EXPECT_EQ(map.points.front().value, 10.0F);
    EXPECT_EQ(map.points.back().value, 20.0F);
    EXPECT_NEAR(opacity(map, 15.0F, 2.0), 0.4, data::kOpacityError);
    EXPECT_EQ(glm::vec3(data::evaluate(map, 15.0F)), glm::vec3(0, 1, 0));
    EXPECT_NEAR(map.points.back().colour.g, 0.21586, 1e-5);  // Of sRGB 128.
}

TEST(MapFile, TheCurveIsASplineUnlessItIsSaidToBeLines) {
    const std::string drawn = R"("colours": [[0, [1, 1, 1]]],
        "opacities": [[0, 0], [0.333333333333, 1], [0.666666666666, 1], [1, 0]])";
    // In the middle of the cubic the weights are 1/8, 3/8, 3/8 and 1/8.
    EXPECT_NEAR(opacity(read("{" + drawn + "}"), 15.0F, 2.0), 0.75, data::kOpacityError);
    EXPECT_NEAR(opacity(read("{" + drawn + R"(, "curve": "lines"})"), 15.0F, 2.0), 1.0, 1e-6);
}

TEST(MapFile, WindowsAndDistancesReplaceTheUsualOnes) {
    const auto map = read(R"({"rgba": [[0, 0, 0, 0], [1, 0, 0, 0.5]], "window": [3, 1],
                              "distance": 0.5})");
    EXPECT_NEAR(opacity(map, 1.0F, 0.5), 0.5, 1e-6);
    EXPECT_EQ(opacity(map, 3.0F, 0.5), 0.0);
}

TEST(MapFile, PercentilesAreThoseOfTheField) {
    MapUsual usual = kUsual;
    for (int p = 0; p <= 100; ++p) usual.percentiles.push_back(static_cast<float>(p * p));
    const auto map = read(R"({"linear": [1, 1, 1], "percentiles": [10, 90]})", usual);
    EXPECT_EQ(map.points.front().value, 100.0F);
    EXPECT_EQ(map.points.back().value, 8100.0F);
}

TEST(MapFile, LinearFadesIn) {
    const auto map = read(R"({"linear": "#ff0000", "opacity": 0.8})");
    EXPECT_EQ(data::evaluate(map, 10.0F), glm::vec4(0.0F));
    EXPECT_FLOAT_EQ(data::evaluate(map, 15.0F).r, 0.5F);
    EXPECT_NEAR(opacity(map, 20.0F, 2.0), 0.8, 1e-6);
}

TEST(MapFile, WhatIsWrongIsNamed) {
    struct Case {
        const char* text;
        const char* says;
    };
    for (const Case& bad : {
             Case{"{\"colours\": [", "is not JSON"},
             Case{"{}", "colours: is missing"},
             Case{R"({"colours": [[0, "red"]]})", "colours[0].colour: is neither"},
             Case{R"({"colours": [[0, "#ff00g0"]]})", "colours[0].colour: is neither"},
             Case{R"({"colours": [[0]]})", "colours[0]: is not a pair"},
             Case{R"({"colours": [["a", "#ffffff"]]})", "colours[0].position"},
             Case{R"({"colours": [[0, "#ffffff"]]})", "opacities: is missing"},
             Case{R"({"colours": [[0, "#ffffff"]], "opacities": [[0, 2]]})",
                  "opacities[0].opacity: 2"},
             Case{R"({"colours": [[0, "#ffffff"]], "opacities": [[0, 1]], "curve": "wavy"})",
                  "curve: is neither"},
             Case{R"({"colours": [[0, "#ffffff"]], "opacities": [[0, 1]], "gain": 1})",
                  "gain: is not a key"},
             Case{R"({"rgba": [[0, 0, 0]]})", "rgba[0]: is not a list of 4 numbers"},
             Case{R"({"rgba": []})", "rgba: there is no entry"},
             Case{R"({"rgba": [[0, 0, 0, 0]], "window": [5, 5]})", "window: 5"},
             Case{R"({"rgba": [[0, 0, 0, 0]], "window": [5]})", "window: is not a list of 2"},
             Case{R"({"rgba": [[0, 0, 0, 0]], "distance": 0})", "distance: 0"},
             Case{R"({"linear": [1, 1, 1], "percentiles": [1, 99]})", "the field has no values"},
             Case{R"({"linear": [1, 1, 1], "percentiles": [0.5, 99]})", "percentiles: 0.5"},
             Case{R"({"linear": [1, 1, 1], "percentiles": [1, 101]})", "percentiles: 101"},
             Case{R"({"linear": [1, 1, 1], "percentiles": [1, 9], "window": [0, 1]})",
                  "percentiles: there is a window, too"},
             Case{R"({"linear": 3})", "linear: is neither"},
             Case{R"({"linear": "#ffffff", "opacity": 1.5})", "opacity: is not from 0 to 1"},
             Case{R"({"points": []})", "has no points"},
             Case{R"({"points": [{"value": 1}, {"value": 0}]})", "points[1]"},
             Case{R"({"points": [{"sigma": 1}]})", "sigma: is not a key"},
         }) {
        const auto map = parseMap(bad.text, kUsual);
        ASSERT_FALSE(map) << bad.text;
        EXPECT_NE(map.error().message.find(bad.says), std::string::npos)
            << bad.text << ": " << map.error().message;
    }
}

}  // namespace
}  // namespace volcast::commands
