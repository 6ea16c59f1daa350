#include "renderer/data/load/formats.h"

#include <gtest/gtest.h>

#include "renderer/data/load/surface_files.h"
#include "renderer/data/load/text_lines.h"
#include "tests/support/import_files.h"

namespace volcast::data::load {
namespace {

TEST(Formats, AreToldByTheLongestSuffixInAnyCase) {
    EXPECT_EQ(formatOf("a/b.NII.gz")->name, "NIfTI");
    EXPECT_EQ(formatOf("x.Vtu")->family, Family::kVtk);
    EXPECT_EQ(formatOf("x.ele"), nullptr);
    EXPECT_EQ(formatOf(".vtu"), nullptr);
    EXPECT_EQ(formatOf("vtu"), nullptr);
    EXPECT_EQ(formatOf("x.gz"), nullptr);
}

TEST(TextLines, SkipsCommentsAndNamesTheLine) {
    TextLines lines{"f.node", "# attributes: a b\n\n1 2.5 nan x 1e999 # rest\n"};
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), 3U);
    ASSERT_EQ(lines.words().size(), 5U);
    EXPECT_EQ(*lines.integer(0), 1);
    EXPECT_EQ(*lines.number(1), 2.5);
    for (const std::size_t i : {2U, 3U, 4U, 5U}) {
        const auto number = lines.number(i);
        ASSERT_FALSE(number.has_value()) << i;
        EXPECT_EQ(number.error().message.find("f.node: line 3: "), 0U) << number.error().message;
    }
    EXPECT_FALSE(lines.integer(1).has_value());
    EXPECT_EQ(attributeNames(lines.comments(), 2, "v"), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(attributeNames(lines.comments(), 1, "v"), (std::vector<std::string>{"v"}));
    EXPECT_FALSE(lines.next());
}

TEST(SurfaceFiles, EqualCornersOfStlTrianglesBecomeOnePoint) {
    const std::string text = test::cubeStlText();
    const auto surface = parseStl("cube.stl", text);
    ASSERT_TRUE(surface.has_value());
    EXPECT_EQ(surface->points.size(), 8U);
    EXPECT_EQ(surface->facets.size(), 12U);
}

TEST(SurfaceFiles, EveryCutOfASurfaceIsRefusedOrWhole) {
    const std::string off = test::cubeOff();
    for (std::size_t length = 0; length + 2 < off.size(); ++length) {
        const auto surface = parseOff("cube.off", std::string_view{off}.substr(0, length));
        EXPECT_FALSE(surface.has_value()) << length;
    }
    const std::string stl = test::cubeStlText();
    const std::size_t end = stl.rfind("endsolid");
    for (std::size_t length = 0; length < end; length += 7) {
        EXPECT_FALSE(parseStl("cube.stl", std::string_view{stl}.substr(0, length)).has_value());
    }
}

TEST(Tetrahedralize, RefusesSwitchesThatChooseFilesOrPrint) {
    const auto surface = parseOff("cube.off", test::cubeOff());
    ASSERT_TRUE(surface.has_value());
    for (const char* switches : {"pk", "pv", "pr", "p -x", "po2", "pV"}) {
        EXPECT_FALSE(tetrahedralize(*surface, switches).has_value()) << switches;
    }
    const auto made = tetrahedralize(*surface, "q1.2");
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_FALSE(made->mesh.cells.empty());
}

}  // namespace
}  // namespace volcast::data::load
