#include <chrono>

#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

using Demo = Import;

TEST_F(Demo, MeshIsAPlateWithAHole) {
    const data::Mesh mesh = this->mesh("demo:mesh");
    EXPECT_GT(mesh.cells.size(), 40'000U);
    EXPECT_LT(mesh.cells.size(), 200'000U);
    EXPECT_FALSE(mesh.convex);
    // 5 x 3.5 x 0.8 without a prism over a regular 48-gon of radius 0.7.
    const double hole = 0.5 * 48 * 0.7 * 0.7 * std::sin(2.0 * 3.14159265358979 / 48) * 0.8;
    EXPECT_NEAR(totalVolume(mesh), 5.0 * 3.5 * 0.8 - hole, 1e-3);
    const data::Field* stress = field(mesh, "von Mises stress");
    ASSERT_NE(stress, nullptr);
    // Kirsch: three times the stress at the hole's side, 90 MPa in the upper face.
    EXPECT_NEAR(stress->range.max, 270.0F, 1.0F);
    EXPECT_NE(field(mesh, "stress, cell mean"), nullptr);
}

TEST_F(Demo, VolumeIsADensityBetweenZeroAndOne) {
    const data::Volume volume = this->volume("demo:volume");
    EXPECT_EQ(volume.size, glm::ivec3(128));
    ASSERT_EQ(volume.channels.size(), 1U);
    EXPECT_GE(volume.channels[0].range.min, 0.0F);
    EXPECT_NEAR(volume.channels[0].range.max, 1.0F, 0.6F);
}

TEST_F(Demo, OtherNamesAreRefused) {
    expectRefused("demo:cow", ErrorCode::kNotFound, "demo:mesh");
}

TEST_F(Demo, ProgressIsReportedAndMeasured) {
    request.path = "demo:volume";
    std::vector<std::string> stages;
    const auto imported = workers::runImport(
        request, settings, [&](const std::string& stage, double) { stages.push_back(stage); });
    ASSERT_TRUE(imported.has_value()) << imported.error().message;
    EXPECT_NE(std::find(stages.begin(), stages.end(), "build"), stages.end());
    EXPECT_GT(imported->ms, 0.0);
    EXPECT_GT(imported->peakMb, 8.0);  // The voxels alone.
}

}  // namespace
}  // namespace volcast::test
