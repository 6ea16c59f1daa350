// What a change costs on the GPU: only what it touches is uploaded, built and drawn again.
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using data::Association;
using scene::RayModel;
using support::addField;
using support::latticeMesh;
using support::perspective;
using support::ruler;

class MeshCost : public support::MeshTest {
protected:
    /// A mesh with a field of each kind, convex or with a hole in it.
    void useMesh(bool convex) {
        auto input = latticeMesh({.cubes = {5, 5, 5}, .keep = [convex](const auto& c) {
                                      return convex || c != glm::ivec3{2};
                                  }});
        addField(input, "p1", Association::kVertex, [](const auto& p) { return p.x; });
        addField(input, "other", Association::kVertex, [](const auto& p) { return p.y; });
        addField(input, "p0", Association::kCell, [](const auto& p) { return p.z; });
        use(std::move(input));
    }
    scene::Scene start() {
        scene::Scene scene =
            sceneOf(perspective({2, 3, 4}, {0.5, 0.5, 0.5}), RayModel::kVolume, ruler(0, 1), "p1");
        draw(scene, {24, 24});
        return scene;
    }
};

TEST_F(MeshCost, CameraMoveUploadsSmallBlocksOnly) {
    for (const bool convex : {true, false}) {
        useMesh(convex);
        scene::Scene scene = start();
        scene.camera = scene::orbit(scene.camera, 20.0);
        const auto work = draw(scene, {24, 24}).info.work;
        EXPECT_LE(work.uploadedBytes, 2048U);
        EXPECT_EQ(work.textureUploads, 0U);
        EXPECT_EQ(work.programsBuilt, 0U);
        EXPECT_EQ(work.drawCalls, 4U);  // Vertices, entries, walk, resolve.
    }
}

TEST_F(MeshCost, MapEditKeepsVerticesAndEntries) {
    useMesh(false);
    scene::Scene scene = start();
    scene.layers[0].map = ruler(0.2F, 0.9F);
    const auto work = draw(scene, {24, 24}).info.work;
    EXPECT_LE(work.uploadedBytes, 4096U);
    EXPECT_EQ(work.programsBuilt, 0U);
    EXPECT_EQ(work.drawCalls, 2U);  // Walk, resolve.
}

TEST_F(MeshCost, FieldAtVerticesIsOneBufferAndTheirPass) {
    useMesh(true);
    scene::Scene scene = start();
    scene.layers[0].field = "other";
    auto work = draw(scene, {24, 24}).info.work;
    EXPECT_EQ(work.programsBuilt, 0U);
    EXPECT_EQ(work.drawCalls, 3U);  // Vertices, walk, resolve.
    EXPECT_GE(work.uploadedBytes, mesh_.vertices.size() * sizeof(float));
    EXPECT_LE(work.uploadedBytes, mesh_.vertices.size() * sizeof(float) + 2048U);
    // Back again, and nothing is uploaded but the layer's block.
    scene.layers[0].field = "p1";
    work = draw(scene, {24, 24}).info.work;
    EXPECT_LE(work.uploadedBytes, 2048U);
}

TEST_F(MeshCost, PictureDependsOnTheLatestOfAllThese) {
    useMesh(false);
    scene::Scene scene = start();
    const auto fresh = [&](const scene::Scene& wanted) {
        return draw(wanted, {24, 24}, 77).linear;  // A view that has kept nothing.
    };
    const auto step = [&](const char* what) {
        EXPECT_EQ(draw(scene, {24, 24}).linear, fresh(scene)) << what;
        renderer_->dropView(77);
    };
    scene.layers[0].field = "other";
    step("field");
    scene.layers[0].field = "p0";
    step("field at cells");
    scene.camera = scene::orbit(scene.camera, 50.0);
    step("camera");
    scene.layers[0].field = "p1";
    step("field at vertices after a move");
    scene.layers[0].model = RayModel::kMip;
    step("model");
    scene.camera = perspective({0.1, 0.2, 0.3}, {0.5, 0.5, 0.5});
    step("camera inside");
}

}  // namespace
}  // namespace volcast
