// Every ray model with every integrator, and every way to choose a part of the data, against the
// reference in double precision.
#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/against_reference.h"

namespace volcast {
namespace {

using scene::Integrator;
using scene::Layer;
using scene::RayModel;
using scene::Scene;
using support::orthographic;
using support::perspective;

constexpr scene::PictureSize kSize{40, 32};

/// Ends, peaks and a stretch without extinction.
data::TransferFunction bentMap() {
    return {{{.value = 0.05F, .colour = {0.1F, 0.2F, 1.0F}, .extinction = 0.0F},
             {.value = 0.3F, .colour = {0.1F, 0.9F, 0.5F}, .extinction = 0.0F},
             {.value = 0.45F, .colour = {1.0F, 0.8F, 0.1F}, .extinction = 3.0F},
             {.value = 0.5F, .colour = {0.9F, 0.1F, 0.1F}, .extinction = 0.2F},
             {.value = 0.9F, .colour = {0.7F, 0.2F, 0.9F}, .extinction = 5.0F}}};
}

/// As above with a step and more points than a sum holds.
data::TransferFunction steppedMap() {
    data::TransferFunction map = bentMap();
    map.points.insert(map.points.begin() + 3,
                      {.value = 0.45F, .colour = {0.0F, 0.0F, 0.2F}, .extinction = 1.0F});
    for (const float value : {0.91F, 0.92F, 0.925F, 1.2F, 1.5F}) {
        map.points.push_back({.value = value, .colour = glm::vec3{value / 2}, .extinction = value});
    }
    return map;
}

class AgainstReference : public support::ReferenceTest {
protected:
    /// A jittered box of cells with fields of all associations; with `hollow`, one with holes and
    /// two components.
    void useBox(bool hollow) {
        const glm::ivec3 cubes{6, 5, 6};
        support::LatticeDesc desc{.cubes = cubes, .low = glm::dvec3{-1}, .high = glm::dvec3{1}};
        desc.move = support::jitter(cubes, desc.low, desc.high, 0.14);
        if (hollow) {
            desc.keep = [](const glm::ivec3& c) {
                const bool hole = c.x == 2 && c.y >= 1 && c.y <= 3;
                const bool gap = c.z == 4 && (c.x > 0 || c.y > 0);
                return !hole && !gap && (c.x + c.y + c.z) % 7 != 6;
            };
        }
        auto input = support::latticeMesh(desc);
        const auto f = [](const glm::dvec3& p) {
            return 0.5 + 0.45 * std::sin(3.0 * p.x + 1.0) * std::cos(2.5 * p.y - p.z);
        };
        const auto g = [](const glm::dvec3& p) { return 0.55 + 0.3 * p.x * p.y + 0.15 * p.z; };
        support::addField(input, "p1", data::Association::kVertex, f);
        support::addField(input, "p0", data::Association::kCell, f);
        support::addField(input, "d1", data::Association::kCellVertex, f);
        support::addField(input, "g1", data::Association::kVertex, g);
        support::addField(input, "g0", data::Association::kCell, g);
        support::addField(input, "mark", data::Association::kCell, [](const glm::dvec3& p) {
            return p.x > 0.1 ? 2.0 : p.y > 0 ? 1.0 : 0.0;
        });
        use(std::move(input));
    }

    static Scene withModel(const scene::Camera& camera, RayModel model, const std::string& field) {
        Scene scene = sceneOf(camera, model, bentMap(), field);
        Layer& layer = scene.layers[0];
        layer.coloured = true;
        layer.levels = {.values = {0.31F, 0.47F, 0.62F}};
        layer.exposure = -1.0F;
        layer.extinctionScale = 0.7F;
        return scene;
    }

    static std::vector<scene::Camera> cameras() {
        return {perspective({2.1, 1.7, 3.3}, {0, 0, 0}),
                perspective({0.21, -0.13, 0.34}, {1, 0.3, -0.2}, 80.0),
                orthographic({-3, 2, 1}, {0, 0, 0}, 3.2)};
    }
};

// The cheap forms are exact where the field is constant in a cell; the exact forms everywhere. A
// float32 walk places ends of pieces to 1e-6 of the mesh, the map's steepest slope (60 a unit of
// value) and the field's (3 a unit of length) make 2e-4 of that at worst for what shows a single
// value, and integrals average it down to 3e-5.
TEST_F(AgainstReference, ExactIntegratorsOfEveryModelOnEveryKindOfField) {
    for (const bool hollow : {false, true}) {
        useBox(hollow);
        for (const scene::RayModelRow& row : scene::rayModels()) {
            if (!row.onMeshes) continue;
            for (const std::string field : {"p1", "d1", "p0"}) {
                if (field == "p0" && row.model == RayModel::kIsosurface) continue;
                for (const auto& camera : cameras()) {
                    const bool sharp = row.combine != scene::Combine::kUnder &&
                                       row.combine != scene::Combine::kSum;
                    const std::string what =
                        std::string{row.name} + " " + field + (hollow ? " hollow" : "");
                    const Scene scene = withModel(camera, row.model, field);
                    if (row.chunk.empty()) {
                        expectRasterClose(scene, kSize, what);
                    } else {
                        expectClose(scene, kSize, sharp ? 2e-4 : 3e-5, what);
                    }
                }
            }
        }
    }
}

TEST_F(AgainstReference, MapsWithStepsAndManyPoints) {
    useBox(true);
    for (const RayModel model :
         {RayModel::kMipColour, RayModel::kXray, RayModel::kSplat, RayModel::kVolume}) {
        Scene scene = withModel(cameras()[0], model, "p1");
        scene.layers[0].map = steppedMap();
        // A step shows where a ray's extreme is beside it; elsewhere the maxima are of points.
        expectClose(scene, kSize, model == RayModel::kMipColour ? 2e-4 : 4e-5,
                    std::string{scene::name(model)});
    }
}

TEST_F(AgainstReference, SecondFields) {
    useBox(true);
    for (const RayModel model : {RayModel::kXray, RayModel::kIsosurface, RayModel::kVolume}) {
        for (const std::string density : {"g1", "g0"}) {
            for (const bool ownMap : {false, true}) {
                Scene scene = withModel(cameras()[0], model, "p1");
                scene.layers[0].densityField = density;
                if (ownMap) scene.layers[0].densityMap = steppedMap();
                // A P0 colour of an isosurface jumps from cell to cell: rays that graze faces.
                expectClose(
                    scene, kSize, model == RayModel::kIsosurface ? 2e-4 : 4e-5,
                    std::string{scene::name(model)} + " " + density + (ownMap ? " own map" : ""));
            }
        }
    }
}

TEST_F(AgainstReference, IntervalsClipPlanesAndMarkersUnderEveryModel) {
    useBox(true);
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onMeshes) continue;
        for (int way = 0; way < 4; ++way) {
            Scene scene = withModel(cameras()[way == 1 ? 1 : 0], row.model, "p1");
            if (way != 1) scene.layers[0].interval = data::Range{.min = 0.35F, .max = 0.7F};
            if (way != 0) {
                scene.clipPlanes = {{.normal = {1, 0.2, 0.3}, .offset = -0.4},
                                    {.normal = {0, -2, 0.5}, .offset = -1.3}};
            }
            if (way > 1) scene.layers[0].markers = {.field = "mark", .values = {0.0F, 2.0F}};
            const bool sharp =
                row.combine != scene::Combine::kUnder && row.combine != scene::Combine::kSum;
            const std::string what = std::string{row.name} + " way " + std::to_string(way);
            if (row.chunk.empty()) {
                expectRasterClose(scene, kSize, what);
            } else {
                expectClose(scene, kSize, sharp ? 2e-4 : 3e-5, what);
            }
        }
    }
}

TEST_F(AgainstReference, LevelsAtTheEndsOfAnIntervalAreDrawn) {
    useBox(true);
    Scene scene = withModel(cameras()[0], RayModel::kIsosurface, "p1");
    scene.layers[0].levels = {.values = {0.2F, 0.35F, 0.5F, 0.7F, 0.8F}};
    const auto all = draw(scene, kSize).linear;
    scene.layers[0].interval = data::Range{.min = 0.35F, .max = 0.7F};
    for (const auto evaluator : {scene::MeshEvaluator::kAuto, scene::MeshEvaluator::kWalk}) {
        scene.layers[0].evaluator = evaluator;
        expectClose(scene, kSize, 2e-4, "levels in an interval");
        const auto some = draw(scene, kSize).linear;
        EXPECT_NE(some, all);
        Scene named = scene;
        named.layers[0].interval.reset();
        named.layers[0].levels.values = {0.35F, 0.5F, 0.7F};
        EXPECT_EQ(some, draw(named, kSize).linear);
    }
}

TEST_F(AgainstReference, ScalesOfValues) {
    useBox(false);
    const scene::Scale log{.kind = scene::Scale::Kind::kLog};
    const scene::Scale power{.kind = scene::Scale::Kind::kPower,
                             .exponent = 0.6F,
                             .domain = data::Range{.min = 0.1F, .max = 0.85F}};
    const scene::Scale clamped{.domain = data::Range{.min = 0.3F, .max = 0.6F}};
    for (const scene::Scale& scale : {log, power, clamped}) {
        for (const RayModel model : {RayModel::kSurface, RayModel::kMip, RayModel::kIsosurface,
                                     RayModel::kSplat, RayModel::kVolume}) {
            Scene scene = withModel(cameras()[0], model, "p1");
            scene.layers[0].scale = scale;
            expectClose(scene, kSize, 2e-4, std::string{scene::name(model)});
        }
    }
}

// Constant fields leave nothing to choose: every integrator is exact.
TEST_F(AgainstReference, EveryIntegratorIsExactWhereTheFieldIsConstant) {
    auto input = support::latticeMesh({.cubes = {3, 3, 3}});
    support::addField(input, "f", data::Association::kVertex, [](const auto&) { return 0.4; });
    use(std::move(input));
    for (const scene::RayModelRow& row : scene::rayModels()) {
        for (const scene::IntegratorRow& integrator : row.integrators) {
            if (row.integrators.size() == 1) continue;
            Scene scene = withModel(perspective({2.1, 1.7, 3.3}, glm::dvec3{0.5}), row.model, "f");
            scene.layers[0].integrator = integrator.integrator;
            // Its table interpolates the map between entries.
            const bool table = integrator.integrator == Integrator::kPreintegrated;
            expectClose(scene, kSize, table ? 2e-3 : 1e-5,
                        std::string{row.name} + " " + std::string{integrator.name});
        }
    }
}

// A map without a bend in the data's range and with one extinction: psi and linear_opacity are
// exact.
TEST_F(AgainstReference, LinearColoursInConstantExtinction) {
    useBox(false);
    Scene scene = withModel(cameras()[0], RayModel::kVolume, "p1");
    scene.layers[0].map = {{{.value = 0.0F, .colour = {0.1F, 0.9F, 0.0F}, .extinction = 3.0F},
                            {.value = 1.0F, .colour = {1.0F, 0.1F, 0.5F}, .extinction = 3.0F}}};
    for (const Integrator integrator :
         {Integrator::kLinearOpacity, Integrator::kPsiTable, Integrator::kPsi}) {
        scene.layers[0].integrator = integrator;
        expectClose(scene, kSize, integrator == Integrator::kPsiTable ? 3e-5 : 1e-5,
                    std::string{scene::name(integrator)});
    }
}

// From cheap to exact, none is worse than the one it improves on.
TEST_F(AgainstReference, BetterIntegratorsAreBetter) {
    useBox(false);
    Scene scene = withModel(cameras()[0], RayModel::kVolume, "p1");
    const auto rms = [&](Integrator integrator) {
        scene.layers[0].integrator = integrator;
        return distance(scene, kSize).rms;
    };
    const double average = rms(Integrator::kAverage), psi = rms(Integrator::kPsi);
    const double table = rms(Integrator::kPsiTable), exact = rms(Integrator::kExact);
    const double linear = rms(Integrator::kLinearOpacity);
    const double preintegrated = rms(Integrator::kPreintegrated);
    EXPECT_GT(average, 1e-3);
    EXPECT_NEAR(table, psi, 2e-5);
    EXPECT_NEAR(linear, psi, 0.5 * psi);
    EXPECT_LT(preintegrated, 0.5 * average);
    EXPECT_LT(exact, 1e-2 * psi);
    EXPECT_LT(exact, 1e-2 * preintegrated);
}

TEST_F(AgainstReference, LayersShareADepthAndAWalk) {
    useBox(true);
    Scene scene = withModel(cameras()[0], RayModel::kVolume, "p1");
    const auto add = [&](const char* id, RayModel model, const std::string& field) -> Layer& {
        Layer layer = withModel(cameras()[0], model, field).layers[0];
        layer.id = id;
        scene.layers.push_back(layer);
        return scene.layers.back();
    };
    add("iso a", RayModel::kIsosurface, "p1").levels = {.values = {0.33F}};
    add("iso b", RayModel::kIsosurface, "p1").levels = {.values = {0.6F}};
    // One walk for the volume and both isosurfaces.
    auto drawn = draw(scene, kSize);
    EXPECT_EQ(drawn.info.plan.layers[1].drawnWith, "layer");
    EXPECT_EQ(drawn.info.plan.layers[2].drawnWith, "layer");
    expectClose(scene, kSize, 2e-4, "volume and two isosurfaces");
    // A surface of marked cells stands in the way of all of them.
    add("plate", RayModel::kSurface, "p1").markers = {.field = "mark", .values = {1.0F}};
    expectClose(scene, kSize, 2e-4, "volume, isosurfaces and a surface");
    // Another volume: no walk can draw all, and by themselves isosurfaces need none.
    add("other", RayModel::kVolume, "g1");
    drawn = draw(scene, kSize);
    for (const std::size_t i : {1, 2}) {
        EXPECT_EQ(drawn.info.plan.layers[i].drawnWith, "");
        EXPECT_EQ(drawn.info.plan.layers[i].evaluator, plan::Evaluator::kMeshProjection);
        EXPECT_TRUE(drawn.info.plan.layers[i].has(plan::kCellsOfLevels));
    }
    expectClose(scene, kSize, 2e-4, "two volumes, isosurfaces and a surface");
    // Where walks are asked for, one does for both.
    for (const std::size_t i : {1, 2}) scene.layers[i].evaluator = scene::MeshEvaluator::kWalk;
    drawn = draw(scene, kSize);
    EXPECT_EQ(drawn.info.plan.layers[1].drawnWith, "");
    EXPECT_EQ(drawn.info.plan.layers[2].drawnWith, "iso a");
    expectClose(scene, kSize, 2e-4, "two volumes, isosurfaces in a walk and a surface");
}

}  // namespace
}  // namespace volcast
