// The transfer function in the shader against its definition in C++, for every way to find a piece.
#include <array>
#include <cmath>
#include <random>

#include "renderer/data/transfer_function.h"
#include "renderer/gpu/target.h"
#include "renderer/scene/map_table.h"
#include "renderer/shading/program_cache.h"
#include "tests/support/gl_test.h"

namespace volcast::scene {
namespace {

using support::must;

class MapTableTest : public support::GlTest {
protected:
    /// classify() of each value, as the shader answers.
    std::vector<glm::vec4> classified(const data::TransferFunction& map,
                                      const std::vector<float>& values) {
        MapTable table;
        must(table.set(device(), {.map = map}));
        search_ = std::get<int>(table.constants().front().value);
        shading::ProgramCache programs{
            device(), [](std::string_view path) -> std::optional<std::string> {
                if (path == "probe.glsl") {
                    return "#include \"classify/transfer_function.glsl\"\n"
                           "layout(binding = 5) uniform samplerBuffer values;\n"
                           "layout(location = 0) out vec4 matter;\n"
                           "void main() {\n"
                           "    matter = classify(texelFetch(values, int(gl_FragCoord.x)).x);\n"
                           "}\n";
                }
                return shading::embeddedChunks()(path);
            }};
        const auto* program =
            must(programs.pass(shading::kFullScreenVertex, "probe.glsl", table.constants()));
        const auto buffer = must(gpu::Buffer::create(
            device(),
            {.bytes = values.size() * 4, .texels = gpu::TexelFormat::kR32F, .label = "values"},
            std::as_bytes(std::span{values})));
        const auto row = must(gpu::Texture2D::create(
            device(), {.size = {static_cast<int>(values.size()), 1}, .label = "row"}));
        const std::array colours{&row};
        const auto target = must(gpu::Target::create(device(), "row", colours));
        target.begin({});
        program->use();
        table.bind();
        buffer.bindTexels(5);
        device().draw(gpu::Primitive::kTriangles, 3);
        std::vector<float> pixels(values.size() * 4);
        target.readRgba32F(pixels);
        std::vector<glm::vec4> answers;
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            answers.emplace_back(pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]);
        }
        return answers;
    }

    void expectAsDefined(const data::TransferFunction& map) {
        ASSERT_TRUE(data::validate(map).has_value());
        std::vector<float> values{-1e30F, 1e30F};
        std::mt19937 random{7};
        for (const data::ControlPoint& point : map.points) {
            values.push_back(point.value);
            values.push_back(std::nextafter(point.value, -1e30F));
            values.push_back(std::nextafter(point.value, 1e30F));
        }
        const float low = map.points.front().value, high = map.points.back().value;
        std::uniform_real_distribution<float> inside{low - 0.1F * (high - low),
                                                     high + 0.1F * (high - low) + 1e-20F};
        for (int i = 0; i < 500; ++i) values.push_back(inside(random));
        // Rounding is relative to the ends of a piece, not to the value between them.
        glm::vec4 largest{1.0F};
        for (const data::ControlPoint& point : map.points) {
            largest = glm::max(largest, glm::vec4(point.colour, point.extinction));
        }
        const std::vector<glm::vec4> answers = classified(map, values);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const glm::vec4 expected = data::evaluate(map, values[i]);
            for (int c = 0; c < 4; ++c) {
                ASSERT_NEAR(answers[i][c], expected[c], 4e-7F * largest[c])
                    << "value " << values[i] << " channel " << c;
            }
            if (expected.a == 0.0F) {
                ASSERT_EQ(answers[i].a, 0.0F) << values[i];
            }
        }
    }

    int search_ = -1;
};

data::TransferFunction evenMap(int count) {
    data::TransferFunction map;
    for (int i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        map.points.push_back({.value = 100.0F + x,
                              .colour = {std::fmod(x * 0.37F, 1.0F), std::fmod(x * 0.61F, 1.0F), x},
                              .extinction = i % 3 == 0 ? 0.0F : x});
    }
    return map;
}

TEST_F(MapTableTest, AFewPointsAreASum) {
    for (const int count : {1, 2, 5, 8}) {
        expectAsDefined(evenMap(count));
        EXPECT_EQ(search_, static_cast<int>(MapSearch::kSlopes));
    }
}

// 1e6 up and down again would leave nothing of 1e-3 in a sum.
TEST_F(MapTableTest, AFewPointsThatWouldCancelAreCompared) {
    data::TransferFunction map = evenMap(5);
    map.points[1].extinction = 1e6F;
    map.points[2].extinction = 1e-3F;
    map.points[3].extinction = 1e-3F;
    expectAsDefined(map);
    EXPECT_EQ(search_, static_cast<int>(MapSearch::kCompareAll));
    EXPECT_EQ(classified(map, {102.5F})[0].a, 1e-3F);
}

TEST_F(MapTableTest, ManyEvenPointsUseAGrid) {
    for (const int count : {9, 33, 255, 1024}) {
        expectAsDefined(evenMap(count));
        EXPECT_EQ(search_, static_cast<int>(MapSearch::kGrid));
    }
}

TEST_F(MapTableTest, UnevenPointsAreHalved) {
    data::TransferFunction map = evenMap(1024);
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        map.points[i].value = std::exp2(static_cast<float>(i) / 16.0F - 32.0F);
    }
    expectAsDefined(map);
    EXPECT_EQ(search_, static_cast<int>(MapSearch::kHalve));
}

TEST_F(MapTableTest, EqualValuesMakeAStepAndTheLastCounts) {
    for (const int repeat : {2, 3, 12}) {
        data::TransferFunction map = evenMap(4);
        for (int i = 0; i < repeat; ++i) {
            map.points.insert(map.points.begin() + 2, map.points[2]);
            map.points[2].colour.r = static_cast<float>(i);
        }
        expectAsDefined(map);
        EXPECT_NE(search_, static_cast<int>(MapSearch::kSlopes)) << "a step has no slope";
    }
    data::TransferFunction all = evenMap(20);
    for (data::ControlPoint& point : all.points) point.value = 3.0F;
    expectAsDefined(all);
}

TEST_F(MapTableTest, NeighbouringFloatsDoNotOverflowTheSlope) {
    const float next = std::nextafter(1e-38F, 1.0F);
    const data::TransferFunction map{{{.value = 1e-38F, .colour = {0, 0, 0}, .extinction = 0.0F},
                                      {.value = next, .colour = {1, 1, 1}, .extinction = 1e30F}}};
    for (const glm::vec4& answer : classified(map, {0.0F, 1e-38F, next, 1.0F})) {
        for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(answer[c]));
    }
}

TEST_F(MapTableTest, AnEditThatFitsIsOneUpdateAndTheSameMapNone) {
    MapTable table;
    must(table.set(device(), {.map = evenMap(5)}));
    const auto before = device().counters().bufferUploads;
    must(table.set(device(), {.map = evenMap(5)}));
    EXPECT_EQ(device().counters().bufferUploads, before);
    must(table.set(device(), {.map = evenMap(7)}));
    EXPECT_EQ(device().counters().bufferUploads, before + 1);
}

}  // namespace
}  // namespace volcast::scene
