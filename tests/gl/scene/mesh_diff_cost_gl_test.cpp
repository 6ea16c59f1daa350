// What each kind of change costs where a mesh is drawn.
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using scene::RayModel;

constexpr scene::PictureSize kSize{24, 16};

class MeshDiffCost : public support::MeshTest {
protected:
    MeshDiffCost() {
        data::MeshInput input = support::latticeMesh({});
        const auto add = [&](const char* name, double slope) {
            support::addField(input, name, data::Association::kVertex,
                              [slope](const glm::dvec3& p) { return slope * p.x; });
        };
        add("f", 1.0);
        add("g", -1.0);
        use(std::move(input));
        const glm::dvec3 center{0.5, 0.5, 0.5};
        scene_ = sceneOf({.eye = center + glm::dvec3(2, 3, 4), .center = center}, RayModel::kVolume,
                         support::ruler(-1.0F, 1.0F), "f");
    }

    scene::FrameInfo drawn() { return draw(scene_, kSize).info; }

    scene::Scene scene_;
};

TEST_F(MeshDiffCost, NothingChangedCostsNothing) {
    drawn();
    const auto info = drawn();
    EXPECT_FALSE(info.drawn);
    EXPECT_EQ(info.work.bufferUploads + info.work.textureUploads + info.work.drawCalls +
                  info.work.programsBuilt,
              0U);
}

TEST_F(MeshDiffCost, ACameraMoveUploadsBlocksAndNoData) {
    drawn();
    scene_.camera.eye.x += 0.1;
    const auto info = drawn();
    EXPECT_LE(info.work.bufferUploads, 2U);
    EXPECT_LE(info.work.uploadedBytes, 1024U);
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.programsBuilt, 0U);
}

TEST_F(MeshDiffCost, AMapEditIsOneTable) {
    drawn();
    scene_.layers[0].map.points[1].colour.b = 0.4F;
    const auto info = drawn();
    EXPECT_EQ(info.work.bufferUploads, 1U);
    // Heads of both maps, sections, and three texels for each of the 3 pieces.
    EXPECT_LE(info.work.uploadedBytes, (28U + 3U * 3U) * 16U);
    EXPECT_EQ(info.work.programsBuilt, 0U);
}

TEST_F(MeshDiffCost, AFieldSwitchIsOneBufferTheFirstTimeAndNothingLater) {
    drawn();
    scene_.layers[0].field = "g";
    auto info = drawn();
    EXPECT_EQ(info.work.bufferUploads, 1U);
    EXPECT_EQ(info.work.uploadedBytes, mesh_.vertices.size() * sizeof(float));
    EXPECT_EQ(info.work.programsBuilt, 0U);
    scene_.layers[0].field = "f";
    info = drawn();
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.bufferUploads, 0U);
}

TEST_F(MeshDiffCost, AModelSwitchUploadsNothing) {
    drawn();
    for (const RayModel model : {RayModel::kMip, RayModel::kSurface, RayModel::kVolume}) {
        scene_.layers[0].model = model;
        const auto info = drawn();
        EXPECT_TRUE(info.drawn);
        EXPECT_EQ(info.work.textureUploads, 0U);
        EXPECT_LE(info.work.uploadedBytes, 1024U);
    }
}

}  // namespace
}  // namespace volcast
