#include <array>
#include <cstddef>

#include "gmock/gmock.h"

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/gpu/timer.h"
#include "renderer/shading/program_cache.h"
#include "tests/support/gl_test.h"
#include "tests/support/layer_constants.h"

namespace volcast {
namespace {

using support::must;

class ProgramTest : public support::GlTest {};

shading::ChunkSource withChunk(std::string path, std::string text) {
    return [path = std::move(path),
            text = std::move(text)](std::string_view wanted) -> std::optional<std::string> {
        if (wanted == path) return text;
        return shading::embeddedChunks()(wanted);
    };
}

TEST_F(ProgramTest, FullScreenPassFillsEveryPixelWithTheTopRowFirst) {
    shading::ProgramCache programs{
        device(),
        withChunk("lib/rows.glsl",
                  "out vec4 colour;\nvoid main() { colour = vec4(gl_FragCoord.xy, 1, 2); }\n")};
    const gpu::Program* program = must(programs.pass(shading::kFullScreenVertex, "lib/rows.glsl"));
    const auto picture = must(gpu::Texture2D::create(
        device(), {.size = {5, 3}, .format = gpu::PixelFormat::kRgba32F, .label = "picture"}));
    const std::array colours{&picture};
    const auto target = must(gpu::Target::create(device(), "target", colours));
    target.begin({});
    program->use();
    device().draw(gpu::Primitive::kTriangles, 3);
    std::vector<float> pixels(std::size_t{5} * 3 * 4);
    target.readRgba32F(pixels);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x) {
            const float* pixel = &pixels[static_cast<std::size_t>(y * 5 + x) * 4];
            EXPECT_EQ(pixel[0], static_cast<float>(x) + 0.5F);
            EXPECT_EQ(pixel[1], static_cast<float>(y) + 0.5F);
        }
    }
}

TEST_F(ProgramTest, ClipSpaceUpIsRowZero) {
    shading::ProgramCache programs{
        device(), [](std::string_view path) -> std::optional<std::string> {
            if (path == "top.vert.glsl") {
                return "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
                       "gl_VertexID == 2 ? 2.0 : 0.0, 0.5, 1.0); }\n";
            }
            return "out vec4 colour;\nvoid main() { colour = vec4(1.0); }\n";
        }};
    const gpu::Program* program = must(programs.pass("top.vert.glsl", "white.glsl"));
    const auto picture = must(gpu::Texture2D::create(device(), {.size = {2, 2}, .label = "p"}));
    const std::array colours{&picture};
    const auto target = must(gpu::Target::create(device(), "target", colours));
    // Counter-clockwise as seen with y up: a front face.
    for (const auto cull : {gpu::Cull::kNone, gpu::Cull::kBack}) {
        target.clearColour(0, glm::vec4(0.0F));
        target.begin({.cull = cull});
        program->use();
        device().draw(gpu::Primitive::kTriangles, 3);
        std::vector<float> pixels(std::size_t{2} * 2 * 4);
        target.readRgba32F(pixels);
        EXPECT_EQ(pixels[0], 1.0F) << "the top row is drawn";
        EXPECT_EQ(pixels[8], 0.0F) << "the bottom row is not";
    }
}

// A volume program whose model is broken in line 4.
TEST_F(ProgramTest, ABrokenChunkIsReportedWithItsFileAndLine) {
    shading::ProgramCache programs{
        device(), withChunk("model/mip.glsl",
                            "struct RayState { float a; };\n"
                            "RayState beginRay(Ray ray) { return RayState(0.0); }\n"
                            "bool stepRay(inout RayState state, inout Segment rest) {\n"
                            "    return undeclaredThing;\n"
                            "}\n"
                            "void enterData(inout RayState s, Segment piece) {}\n"
                            "bool skipsBetween(RayState s, float lo, float hi) { return false; }\n"
                            "vec4 endRay(RayState s, float facing) { return vec4(0.0); }\n"
                            "float hitDistance(RayState s) { return kNoHit; }\n"
                            "vec4 packRay(RayState s) { return vec4(s.a); }\n"
                            "RayState unpackRay(vec4 v) { return RayState(v.r); }\n")};
    std::vector<shading::Constant> constants = support::layerConstants(0);
    constants.insert(constants.end(), {{"kSampling", 1},
                                       {"kFilterInHardware", true},
                                       {"kSkipBricks", true},
                                       {"kEarlyStop", true},
                                       {"kBrickSize", 16},
                                       {"kMaxRaySamples", 100}});
    const Result<const gpu::Program*> program =
        programs.ray({.evaluator = "volume/march.glsl",
                      .classify = "classify/transfer_function.glsl",
                      .segment = "",
                      .model = "model/mip.glsl",
                      .constants = constants});
    ASSERT_TRUE(program.has_error());
    EXPECT_EQ(program.error().code, ErrorCode::kShaderBuild);
    EXPECT_THAT(program.error().message, ::testing::HasSubstr("model/mip.glsl:4:"));
    EXPECT_THAT(program.error().message, ::testing::HasSubstr("undeclaredThing"));
}

// A slot that is left out although the model calls it is found when the program is compiled.
TEST_F(ProgramTest, ASlotThatIsCalledButEmptyDoesNotBuild) {
    shading::ProgramCache programs{device(),
                                   withChunk("lib/evaluator.glsl",
                                             "out vec4 colour;\nvoid main() {\n"
                                             "    colour = integrateSegment(Segment(0, 0, 0, 0));\n"
                                             "}\n")};
    shading::Recipe recipe{.evaluator = "lib/evaluator.glsl",
                           .classify = "",
                           .segment = "",
                           .model = "",
                           .constants = {}};
    const Result<const gpu::Program*> program = programs.ray(recipe);
    ASSERT_TRUE(program.has_error());
    EXPECT_THAT(program.error().message, ::testing::HasSubstr("lib/evaluator.glsl:3:"));
}

TEST_F(ProgramTest, StagesThatDoNotFitDoNotLink) {
    shading::ProgramCache programs{device(),
                                   withChunk("lib/in.glsl",
                                             "in vec3 notWritten;\nout vec4 colour;\n"
                                             "void main() { colour = vec4(notWritten, 1.0); }\n")};
    const Result<const gpu::Program*> program =
        programs.pass(shading::kFullScreenVertex, "lib/in.glsl");
    ASSERT_TRUE(program.has_error());
    EXPECT_EQ(program.error().code, ErrorCode::kShaderBuild);
}

TEST_F(ProgramTest, BuffersAreReadAsTexels) {
    shading::ProgramCache programs{
        device(), withChunk("lib/texels.glsl",
                            "layout(binding = 3) uniform samplerBuffer values;\n"
                            "out vec4 colour;\n"
                            "void main() { colour = texelFetch(values, int(gl_FragCoord.x)); }\n")};
    const gpu::Program* program =
        must(programs.pass(shading::kFullScreenVertex, "lib/texels.glsl"));
    const std::array<float, 8> values{1, 2, 3, 4, 5, 6, 7, 8};
    const auto before = device().counters();
    const auto buffer = must(gpu::Buffer::create(
        device(), {.bytes = 32, .texels = gpu::TexelFormat::kRgba32F, .label = "values"},
        std::as_bytes(std::span{values})));
    EXPECT_EQ(device().counters().bufferUploads - before.bufferUploads, 1U);
    EXPECT_EQ(device().counters().uploadedBytes - before.uploadedBytes, 32U);
    const auto picture = must(gpu::Texture2D::create(device(), {.size = {2, 1}, .label = "p"}));
    const std::array colours{&picture};
    const auto target = must(gpu::Target::create(device(), "target", colours));
    target.begin({});
    program->use();
    buffer.bindTexels(3);
    device().draw(gpu::Primitive::kTriangles, 3);
    std::vector<float> pixels(8);
    target.readRgba32F(pixels);
    EXPECT_THAT(pixels, ::testing::ElementsAreArray(values));
}

TEST_F(ProgramTest, AProgramIsBuiltOnce) {
    shading::ProgramCache programs{
        device(),
        withChunk("lib/white.glsl", "out vec4 colour;\nvoid main() { colour = vec4(1.0); }\n")};
    const auto before = device().counters().programsBuilt;
    const gpu::Program* first = must(programs.pass(shading::kFullScreenVertex, "lib/white.glsl"));
    EXPECT_EQ(must(programs.pass(shading::kFullScreenVertex, "lib/white.glsl")), first);
    EXPECT_NE(must(programs.pass(shading::kFullScreenVertex, "lib/white.glsl", {{"kOther", 1}})),
              first);
    EXPECT_EQ(device().counters().programsBuilt - before, 2U);
}

}  // namespace
}  // namespace volcast
