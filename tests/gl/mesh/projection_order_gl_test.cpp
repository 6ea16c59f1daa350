// Which cells come first, what that costs, and what is said about it.
#include "renderer/scene/ray_models.h"
#include "tests/support/delaunay.h"
#include "tests/support/projection_test.h"

namespace volcast {
namespace {

using scene::MeshEvaluator;
using scene::RayModel;
using support::bentMap;
using support::Drawn;
using support::perspective;

class ProjectionOrder : public support::ProjectionTest {
protected:
    scene::Scene sceneFor(RayModel model) {
        scene::Scene scene = sceneOf(perspective({3.1, 2.3, 4.4}, {0, 0, 0}), model, bentMap(3.0F));
        scene.layers[0].evaluator = MeshEvaluator::kProjection;
        scene.layers[0].levels = {.values = {0.1F}};
        return scene;
    }
    mesh::OrderReport reportOf(const scene::Scene& scene) {
        const Drawn drawn = draw(scene, {16, 16});
        EXPECT_EQ(drawn.info.orders.size(), 1U);
        EXPECT_EQ(drawn.info.orders.at(0).layer, "layer");
        return drawn.info.orders.at(0).report;
    }
};

TEST_F(ProjectionOrder, IsReportedWithItsViolations) {
    use(support::withFields(support::randomDelaunay(150, 5)));
    mesh::OrderReport report = reportOf(sceneFor(RayModel::kVolume));
    EXPECT_EQ(report.cells, static_cast<std::int64_t>(mesh_.cells.size()));
    EXPECT_TRUE(report.byPowerDistance);
    EXPECT_EQ(report.sortViolations, 0);
    EXPECT_EQ(report.orderViolations, 0);

    use(support::withFields(support::projectionShapes()[0].mesh));
    report = reportOf(sceneFor(RayModel::kVolume));
    EXPECT_FALSE(report.byPowerDistance);
    EXPECT_GT(report.sortViolations, 0);
    EXPECT_EQ(report.orderViolations, 0);
    EXPECT_GE(report.milliseconds, 0.0);

    // Cells that hide one another in a circle have no right order.
    use(support::withFields(support::shutterMesh()));
    scene::Scene scene = sceneFor(RayModel::kVolume);
    scene.camera = perspective({0, 0, 0}, {1, 0, 0.2}, 60.0);
    report = reportOf(scene);
    EXPECT_EQ(report.cells, 12);
    EXPECT_EQ(report.orderViolations, 1);
}

// Only the model that needs an order sorts, and only when the camera moves.
TEST_F(ProjectionOrder, CostsNothingWhereItMakesNoDifference) {
    const auto& input = support::projectionShapes()[0].mesh;
    use(support::withFields(input));
    const std::size_t order = mesh_.cells.size() * sizeof(std::int32_t);
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (row.chunk.empty()) continue;
        SCOPED_TRACE(row.name);
        const bool sorts = row.model == RayModel::kVolume;
        scene::Scene scene = sceneFor(row.model);
        EXPECT_EQ(draw(scene, {24, 24}).info.orders.empty(), !sorts);
        scene.camera = scene::orbit(scene.camera, 20.0);
        auto work = draw(scene, {24, 24}).info.work;
        EXPECT_LE(work.uploadedBytes, 2048U + (sorts ? order : 0U));
        EXPECT_GE(work.uploadedBytes, sorts ? order : 0U);
        EXPECT_EQ(work.textureUploads, 0U);
        EXPECT_EQ(work.programsBuilt, 0U);
        // Vertices, cells, what they make together (not of opaque models), resolve.
        EXPECT_EQ(work.drawCalls, row.opaque ? 3U : 4U);
        scene.layers[0].map = bentMap(2.0F);
        work = draw(scene, {24, 24}).info.work;
        EXPECT_LE(work.uploadedBytes, 4096U);
        EXPECT_EQ(work.drawCalls, row.opaque ? 2U : 3U);
    }
}

TEST_F(ProjectionOrder, PictureDependsOnTheLatestOfAllThatChanges) {
    use(support::withFields(support::projectionShapes()[2].mesh));
    scene::Scene scene = sceneFor(RayModel::kVolume);
    draw(scene, {24, 24});
    const auto step = [&](const char* what) {
        EXPECT_EQ(draw(scene, {24, 24}).linear, draw(scene, {24, 24}, 77).linear) << what;
        renderer_->dropView(77);
    };
    scene.camera = scene::orbit(scene.camera, 50.0);
    step("camera");
    scene.layers[0].field = "p0";
    step("field at cells");
    scene.layers[0].model = RayModel::kMip;
    step("a model without an order");
    scene.camera = scene::orbit(scene.camera, 50.0);
    step("camera, unsorted");
    scene.layers[0].model = RayModel::kVolume;
    step("sorted again");
    scene.layers[0].evaluator = MeshEvaluator::kWalk;
    step("walk");
    scene.layers[0].evaluator = MeshEvaluator::kProjection;
    step("projection");
    scene.camera = perspective({0.1, 0.2, 0.3}, {0.5, 0.5, 0.5});
    step("camera inside");
    scene.camera = sceneFor(RayModel::kVolume).camera;
    scene.layers[0].model = RayModel::kIsosurface;
    scene.layers[0].field = "p1";
    scene.layers[0].levels = {.values = {0.2F}};
    step("an isosurface");
    scene.layers[0].levels = {.values = {-0.3F, 0.4F}};
    step("other levels");
    scene.layers[0].field = "d1";
    step("another field");
    scene.camera = scene::orbit(scene.camera, 50.0);
    step("camera, isosurface");
    scene.layers[0].levels = {.values = {1.0e6F}};
    step("a level that no cell meets");
}

}  // namespace
}  // namespace volcast
