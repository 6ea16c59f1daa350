#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

/// Counts as the data's own documents have them.
class RealData : public Import {
protected:
    void SetUp() override {
        folder_ = realData();
        if (folder_.empty()) GTEST_SKIP() << "no folder $VOLCAST_DATA";
    }
    std::string at(const std::string& name) const { return folder_ + "/" + name; }
    void expectMesh(const std::string& name, std::size_t vertices, std::size_t cells,
                    const std::string& fieldName, float low, float high) {
        const data::Mesh mesh = this->mesh(at(name));
        EXPECT_EQ(mesh.vertices.size(), vertices) << name;
        EXPECT_EQ(mesh.cells.size() + mesh.cellsWithoutVolume, cells) << name;
        const data::Field* values = field(mesh, fieldName);
        ASSERT_NE(values, nullptr) << name;
        EXPECT_NEAR(values->range.min, low, 0.02 * std::abs(low)) << name;
        EXPECT_NEAR(values->range.max, high, 0.02 * std::abs(high)) << name;
    }
    void expectVolume(const std::string& name, glm::ivec3 size, data::VoxelType type) {
        const data::Volume volume = this->volume(at(name));
        EXPECT_EQ(volume.size, size) << name;
        EXPECT_EQ(volume.type, type) << name;
        ASSERT_EQ(volume.channels.size(), 1U) << name;
        EXPECT_GT(volume.channels[0].range.max, volume.channels[0].range.min) << name;
    }

private:
    std::string folder_;
};

TEST_F(RealData, Meshes) {
    // 19 of its 40,940 points coincide with another one.
    expectMesh("bluntfin.vtu", 40'921, 187'318, "Density", 0.19F, 4.98F);
    expectMesh("disk_out_ref.vtu", 8'499, 44'832, "Temp", 293.15F, 913.15F);
    expectMesh("disk_out_ref.node", 8'499, 44'832, "Temp", 293.15F, 913.15F);
}

TEST_F(RealData, ExodusHexahedraAreSplitWithoutGaps) {
    const data::Mesh split = this->mesh(at("disk_out_ref.ex2"));
    const data::Mesh other = this->mesh(at("disk_out_ref.vtu"));
    EXPECT_EQ(split.vertices.size(), other.vertices.size());
    EXPECT_NEAR(totalVolume(split) / totalVolume(other), 1.0, 1e-3);
    // Gaps inside would show as boundary faces.
    EXPECT_EQ(split.boundaryFaces.size(), other.boundaryFaces.size());
    for (const char* name :
         {"Temp", "V", "V_x", "V_y", "V_z", "Pres", "AsH3", "GaMe3", "CH4", "H2"}) {
        EXPECT_NE(field(split, name), nullptr) << name;
    }
}

TEST_F(RealData, Volumes) {
    expectVolume("headsq.mhd", {64, 64, 93}, data::VoxelType::kU16);
    expectVolume("ironProt.mhd", {68, 68, 68}, data::VoxelType::kU8);
    expectVolume("ironProt.vtk", {68, 68, 68}, data::VoxelType::kU8);
    expectVolume("carotid.mhd", {76, 49, 45}, data::VoxelType::kF32);
    expectVolume("neghip.mhd", {66, 66, 66}, data::VoxelType::kU8);
    expectVolume("hydrogen.vti", {64, 64, 64}, data::VoxelType::kF32);
}

TEST_F(RealData, SpacingAndRangeOfTheHead) {
    const data::Volume head = volume(at("headsq.mhd"));
    EXPECT_DOUBLE_EQ(head.spacing.x, 3.2);
    EXPECT_DOUBLE_EQ(head.spacing.z, 1.5);
    EXPECT_EQ(head.channels.at(0).range, (data::Range{0.0F, 3926.0F}));
}

}  // namespace
}  // namespace volcast::test
