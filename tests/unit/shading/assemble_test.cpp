#include "renderer/shading/assemble.h"

#include <map>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

#include "renderer/shading/embedded_chunks.h"
#include "renderer/shading/glsl_scan.h"

namespace volcast::shading {
namespace {

using ::testing::HasSubstr;

/// Chunks of a small program, each replaceable.
class Assemble : public ::testing::Test {
protected:
    ChunkSource source() {
        return [this](std::string_view path) -> std::optional<std::string> {
            const auto found = chunks_.find(std::string{path});
            if (found == chunks_.end()) return std::nullopt;
            return found->second;
        };
    }
    Recipe recipe_{.evaluator = "e.glsl",
                   .classify = "c.glsl",
                   .segment = "s.glsl",
                   .model = "m.glsl",
                   .constants = {}};
    std::map<std::string, std::string> chunks_{
        {"contract/ray.glsl", "struct Ray { vec3 o; };\n"},
        {"contract/segment.glsl", "struct Segment { float f; };\n"},
        {"lib/a.glsl", "float a() { return 1.0; }\n"},
        {"c.glsl",
         "#include \"lib/a.glsl\"\nvec4 classify(float v) { return vec4(a()); }\n"
         "vec4 matterAt(float f, float g) { return classify(f); }\n"
         "bool transparentBetween(float lo, float hi) { return false; }\n"},
        {"s.glsl",
         "#include \"lib/a.glsl\"\n\nvec4 integrateSegment(Segment p) { return classify(p.f); }\n"},
        {"m.glsl",
         "struct RayState { vec4 c; };\nRayState beginRay(Ray r) { return RayState(vec4(0)); }\n"
         "bool stepRay(inout RayState s, Segment p) { return false; }\n"
         "bool skipsBetween(RayState s, float lo, float hi) { return false; }\n"
         "void enterData(inout RayState s, Segment p) {}\n"
         "vec4 endRay(RayState s, float facing) { return s.c; }\n"
         "float hitDistance(RayState s) { return 0.0; }\n"
         "vec4 packRay(RayState s) { return s.c; }\n"
         "RayState unpackRay(vec4 v) { return RayState(v); }\n"},
        {"e.glsl", "out vec4 colour;\nvoid main() {\n    colour = vec4(0.0);\n}\n"}};
};

TEST_F(Assemble, JoinsSlotsInOrderAndEachIncludeOnce) {
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_value()) << assembled.error().message;
    const std::string& text = assembled->source;
    EXPECT_EQ(text.rfind("#version 450 core\n", 0), 0U);
    EXPECT_EQ(text.find("float a()"), text.rfind("float a()"));
    EXPECT_LT(text.find("vec4 classify"), text.find("vec4 integrateSegment"));
    EXPECT_LT(text.find("vec4 integrateSegment"), text.find("struct RayState"));
    EXPECT_LT(text.find("struct RayState"), text.find("void main"));
    EXPECT_THAT(text, ::testing::Not(HasSubstr("#include")));
}

TEST_F(Assemble, ConstantsAreTypedAndPrecise) {
    recipe_.constants = {{"kOn", true}, {"kCount", 512}, {"kThird", 1.0F / 3.0F}, {"kTwo", 2.0F}};
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_value());
    EXPECT_THAT(assembled->source, HasSubstr("const bool kOn = true;\n"));
    EXPECT_THAT(assembled->source, HasSubstr("const int kCount = 512;\n"));
    EXPECT_THAT(assembled->source, HasSubstr("const float kThird = 0.333333343;\n"));
    EXPECT_THAT(assembled->source, HasSubstr("const float kTwo = 2.0;\n"));
}

TEST_F(Assemble, EveryLineKnowsItsFileAndLine) {
    recipe_.constants = {{"kOn", true}};
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_value());
    std::size_t line = 0, start = 0;
    while (start < assembled->source.size()) {
        const std::size_t end = assembled->source.find('\n', start);
        const std::string text = assembled->source.substr(start, end - start);
        const LineOrigin& origin = assembled->lines.at(line++);
        start = end + 1;
        if (!chunks_.contains(origin.file)) continue;
        std::string expected = chunks_[origin.file];
        for (int skip = 1; skip < origin.line; ++skip) {
            expected = expected.substr(expected.find('\n') + 1);
        }
        EXPECT_EQ(text, expected.substr(0, expected.find('\n'))) << origin.file << origin.line;
    }
    EXPECT_EQ(line, assembled->lines.size());
}

TEST_F(Assemble, DriverLogsPointIntoTheChunk) {
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_value());
    std::size_t line = 0;
    while (assembled->lines[line].file != "s.glsl" || assembled->lines[line].line != 3) ++line;
    const std::string n = std::to_string(line + 1);
    EXPECT_EQ(assembled->translate("0:" + n + "(14): error: no match"),
              "s.glsl:3: error: no match");
    EXPECT_EQ(assembled->translate("0(" + n + ") : error C1008"), "s.glsl:3: error C1008");
    EXPECT_EQ(assembled->translate("ERROR: 0:" + n + ": bad\nnext"), "ERROR: s.glsl:3: bad\nnext");
    EXPECT_EQ(assembled->translate("0:99999(1): error"), "0:99999(1): error");
    EXPECT_EQ(assembled->translate("no place here"), "no place here");
}

TEST_F(Assemble, AMissingSlotFunctionNamesItsChunk) {
    chunks_["s.glsl"] = "vec4 integrateSegment(Segment p);  // only declared\n";
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_error());
    EXPECT_EQ(assembled.error().code, ErrorCode::kShaderBuild);
    EXPECT_THAT(assembled.error().message, HasSubstr("s.glsl"));
    EXPECT_THAT(assembled.error().message, HasSubstr("integrateSegment"));
}

TEST_F(Assemble, ADoubledSlotFunctionNamesBothPlaces) {
    chunks_["e.glsl"] += "\nvec4 classify(float v) { return vec4(1.0); }\n";
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_error());
    EXPECT_EQ(assembled.error().code, ErrorCode::kShaderBuild);
    EXPECT_THAT(assembled.error().message, HasSubstr("e.glsl:6"));
    EXPECT_THAT(assembled.error().message, HasSubstr("c.glsl:2"));
}

TEST_F(Assemble, AMissingChunkNamesWhoWantsIt) {
    chunks_["s.glsl"].insert(0, "// one\n#include \"lib/gone.glsl\"\n");
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_error());
    EXPECT_THAT(assembled.error().message, HasSubstr("s.glsl:2"));
    EXPECT_THAT(assembled.error().message, HasSubstr("lib/gone.glsl"));
    recipe_.model = "model/none.glsl";
    chunks_["s.glsl"] = "vec4 integrateSegment(Segment p) { return vec4(0.0); }\n";
    EXPECT_THAT(assemble(recipe_, source()).error().message, HasSubstr("model/none.glsl"));
}

TEST_F(Assemble, AnIncludeCycleIsAnError) {
    chunks_["lib/a.glsl"] = "#include \"lib/b.glsl\"\nfloat a() { return 1.0; }\n";
    chunks_["lib/b.glsl"] = "\n#include \"lib/a.glsl\"\n";
    const auto assembled = assemble(recipe_, source());
    ASSERT_TRUE(assembled.has_error());
    EXPECT_THAT(assembled.error().message, HasSubstr("lib/b.glsl:2"));
}

TEST_F(Assemble, ARecipeWithoutEvaluatorAndAPassWithoutMainAreErrors) {
    recipe_.evaluator.clear();
    EXPECT_EQ(assemble(recipe_, source()).error().code, ErrorCode::kShaderBuild);
    EXPECT_EQ(assembleFile("lib/a.glsl", {}, source()).error().code, ErrorCode::kShaderBuild);
    EXPECT_TRUE(assembleFile("e.glsl", {}, source()).has_value());
}

TEST(GlslScan, FindsDefinitionsOnlyAtTheOutermostLevel) {
    const auto found = functionDefinitions(
        "// void hidden() {}\n"
        "/* void hidden2() { */\n"
        "struct S { float a; };\n"
        "float declared(float x);\n"
        "float first(float x, vec2 y)\n"
        "{ if (x > 0.0) { return f(x); } return 1.0; }\n"
        "layout(std140) uniform B { float z; };\n"
        "void second() { for (;;) { } }\n");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "first");
    EXPECT_EQ(found[0].line, 6);
    EXPECT_EQ(found[1].name, "second");
    EXPECT_EQ(found[1].line, 8);
}

// A variant is another chunk or a constant: the preprocessor has no part in it.
TEST(Chunks, HoldNoPreprocessorButIncludes) {
    ASSERT_FALSE(embeddedChunkTable().empty());
    for (const EmbeddedChunk& chunk : embeddedChunkTable()) {
        std::size_t at = 0;
        while ((at = chunk.text.find("\n#", at)) != std::string_view::npos) {
            ++at;
            EXPECT_EQ(chunk.text.substr(at, 10), "#include \"") << chunk.path;
        }
    }
}

TEST(Chunks, AFolderGivesWhatWasEmbeddedAndNothingOutside) {
    EXPECT_FALSE(chunksFrom("/nonexistent")("model/mip.glsl").has_value());
    EXPECT_FALSE(chunksFrom("/")("etc/../etc/passwd").has_value());
    EXPECT_FALSE(chunksFrom("")("/etc/passwd").has_value());
}

}  // namespace
}  // namespace volcast::shading
