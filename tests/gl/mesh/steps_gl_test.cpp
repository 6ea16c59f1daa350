// What a picture took, as its shaders count it.
#include <cmath>

#include "renderer/reference/reference.h"
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using scene::Integrator;
using scene::RayModel;
using support::fog;
using support::orthographic;
using support::perspective;

constexpr scene::PictureSize kSize{40, 32};

class Steps : public support::MeshTest {
protected:
    void useBox() {
        const glm::ivec3 cubes{6, 5, 4};
        auto input = support::latticeMesh(
            {.cubes = cubes, .move = support::jitter(cubes, glm::dvec3{0}, glm::dvec3{1}, 0.12)});
        support::addField(input, "f", data::Association::kVertex,
                          [](const glm::dvec3& p) { return p.x + 0.5 * std::sin(3.0 * p.y); });
        use(std::move(input));
    }

    scene::Scene boxScene(RayModel model, Integrator integrator = Integrator::kAuto) {
        auto scene = sceneOf(perspective({2.1, 1.7, 2.9}, glm::dvec3{0.5}, 25.0), model,
                             {{{.value = 0.3F, .colour = {1, 0, 0}, .extinction = 0.1F},
                               {.value = 0.6F, .colour = {0, 1, 0}, .extinction = 0.2F},
                               {.value = 0.9F, .colour = {0, 0, 1}, .extinction = 0.1F}}});
        scene.layers[0].integrator = integrator;
        return scene;
    }

    scene::FrameInfo counted(const scene::Scene& scene, scene::PictureSize size) {
        auto info = support::must(renderer_->render(1, scene, size, {.countsSteps = true}));
        EXPECT_EQ(info.steps.size(), 1U);
        EXPECT_EQ(info.steps.at(0).layer, "layer");
        return info;
    }
    std::uint64_t walkSteps(const scene::Scene& scene, scene::PictureSize size) {
        return counted(scene, size).steps[0].walkSteps;
    }
    std::uint64_t cellsMet(const scene::Scene& scene, scene::PictureSize size) {
        return support::must(
                   reference::draw(
                       scene, std::map<std::string, const data::Mesh*>{{"mesh", &mesh_}}, size))
            .piecesVisited;
    }
};

TEST_F(Steps, OfConvexMeshesAreTheCellsThatTheReferencesRaysMeet) {
    useBox();
    for (const Integrator integrator : {Integrator::kAverage, Integrator::kPsi}) {
        auto scene = boxScene(RayModel::kVolume, integrator);
        for (int turn = 0; turn < 4; ++turn) {
            scene.camera = scene::orbit(scene.camera, 71.0);
            const std::uint64_t cells = cellsMet(scene, kSize);
            EXPECT_GT(cells, 5U * kSize.x * kSize.y);
            EXPECT_EQ(walkSteps(scene, kSize), cells) << turn;
        }
    }
    const auto mip = boxScene(RayModel::kMip);
    EXPECT_EQ(walkSteps(mip, kSize), cellsMet(mip, kSize));
}

TEST_F(Steps, PartsOfSplitPiecesAreSteps) {
    useBox();
    const auto exact = boxScene(RayModel::kVolume, Integrator::kExact);
    EXPECT_GT(walkSteps(exact, kSize), cellsMet(exact, kSize));
}

TEST_F(Steps, OfAllDrawsOfRaysTooLongForOneAreAddedUp) {
    const int n = 6001;
    use(support::latticeMesh({.cubes = {1, 1, n}, .high = {1, 1, n}, .keep = [](const auto& c) {
                                  return c.z != 4000;
                              }}));
    auto scene = sceneOf(orthographic({0.51, 0.52, n + 10.0}, {0.51, 0.52, 0}, 0.8),
                         RayModel::kVolume, fog(1e-5F));
    scene.layers[0].integrator = Integrator::kAverage;
    const scene::PictureSize size{4, 4};
    // The first draw's steps are taken again: some 8100 a ray, as two rounds go into entering.
    const std::uint64_t least = cellsMet(scene, size) + 16U * 8000U;
    const std::uint64_t steps = walkSteps(scene, size);
    EXPECT_GE(steps, least);
    EXPECT_LT(steps, least + 16U * 200U);
}

TEST_F(Steps, AreCountedByAnotherProgramOnlyWhereAskedFor) {
    useBox();
    const auto scene = boxScene(RayModel::kVolume);
    const auto plain = draw(scene, kSize);
    EXPECT_TRUE(plain.info.steps.empty());
    const scene::FrameInfo first = counted(scene, kSize);
    EXPECT_TRUE(first.drawn);
    EXPECT_EQ(first.work.programsBuilt, 1U);
    EXPECT_EQ(counted(scene, kSize).steps[0].walkSteps, first.steps[0].walkSteps);
    auto turned = scene;
    turned.camera = scene::orbit(scene.camera, 10.0);
    draw(turned, kSize);
    const auto again = draw(scene, kSize);
    EXPECT_TRUE(again.info.steps.empty());
    EXPECT_EQ(again.info.work.programsBuilt, 0U);
    EXPECT_EQ(again.linear, plain.linear);
}

TEST_F(Steps, OfTheProjectionAreItsCells) {
    useBox();
    auto scene = boxScene(RayModel::kVolume);
    scene.layers[0].evaluator = scene::MeshEvaluator::kProjection;
    const scene::FrameInfo info = counted(scene, kSize);
    EXPECT_EQ(info.steps[0].cellsDrawn, mesh_.cells.size());
    EXPECT_EQ(info.steps[0].walkSteps, 0U);
    // Of an isosurface those that have corners on both sides of the level.
    scene = boxScene(RayModel::kIsosurface);
    scene.layers[0].levels = {.values = {0.3F}};
    const auto& values = mesh_.fields.at(0).steps.at(0);
    std::size_t met = 0;
    for (const glm::ivec4& cell : mesh_.cells.span()) {
        int below = 0;
        for (int i = 0; i < 4; ++i) {
            below += values[static_cast<std::size_t>(cell[i])] < 0.3F ? 1 : 0;
        }
        if (below > 0 && below < 4) ++met;
    }
    EXPECT_GT(met, 0U);
    EXPECT_LT(met, mesh_.cells.size());
    EXPECT_EQ(counted(scene, kSize).steps[0].cellsDrawn, met);
}

}  // namespace
}  // namespace volcast
