// Pictures that are drawn in parts: the same as in one go, and ended by another picture of the
// view.
#include <cmath>

#include "tests/support/mesh_scenes.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;
using support::Drawn;

constexpr scene::PictureSize kSize{96, 200};  // Three times the fewest rows, and a rest.
constexpr double kAsSoonAsCanBe = 1e-6;

class PicturesInParts : public support::MeshTest {
protected:
    PicturesInParts() {
        renderer_->addDataset(
            "waves",
            support::volumeOf({.size = {12, 12, 12}, .origin = {-6, -6, -6}},
                              [](const auto& p) { return 0.5 + 0.5 * std::sin(p.x + p.y); }));
        data::MeshInput cell;
        cell.points = {{-5, -5, 0}, {5, -5, 1}, {0, 5, 0}, {0, 0, -4}};
        cell.cells = {{0, 1, 2, 3}};
        use(cell);
        scene_.camera = {.eye = {1, 2, 30}, .center = {0, 0, 0}};
        addLayer("waves", RayModel::kVolume);
    }
    scene::Layer& addLayer(const std::string& dataset, RayModel model) {
        scene::Layer& layer = scene_.layers.emplace_back();
        layer.id = "layer " + std::to_string(scene_.layers.size());
        layer.dataset = dataset;
        layer.model = model;
        layer.map = support::fog(0.2F);
        if (model == RayModel::kIsosurface) layer.levels.values = {0.4F};
        return layer;
    }
    /// One call; pixels are there where it finished.
    Drawn part(const scene::Scene& scene, std::uint64_t view = 2) {
        Drawn drawn;
        drawn.size = kSize;
        drawn.linear.resize(static_cast<std::size_t>(kSize.x) * kSize.y * 4);
        drawn.bytes.resize(drawn.linear.size());
        drawn.info = support::must(renderer_->render(
            view, scene, kSize,
            {.rgba8 = drawn.bytes, .rgba32f = drawn.linear, .partMs = kAsSoonAsCanBe}));
        return drawn;
    }
    /// All parts, and how many there were.
    std::pair<Drawn, int> allParts(const scene::Scene& scene, std::uint64_t view = 2) {
        for (int parts = 1;; ++parts) {
            Drawn drawn = part(scene, view);
            if (drawn.info.finished || parts == 100) return {std::move(drawn), parts};
        }
    }
    void expectSameInParts(int parts) {
        const Drawn whole = draw(scene_, kSize);
        const auto [drawn, count] = allParts(scene_);
        EXPECT_EQ(count, parts);
        EXPECT_EQ(drawn.linear, whole.linear);
        EXPECT_EQ(drawn.bytes, whole.bytes);
        EXPECT_TRUE(drawn.info.drawn);
    }
    scene::Scene scene_;
};

TEST_F(PicturesInParts, AreTheSameAsInOneGo) {
    EXPECT_TRUE(draw(scene_, kSize).info.finished);
    expectSameInParts(4);
}

TEST_F(PicturesInParts, MayHaveSeveralLayersAndModels) {
    addLayer("mesh", RayModel::kSurface);  // Opaque, and drawn first: a part of its own.
    addLayer("mesh", RayModel::kVolume);   // As this one.
    addLayer("waves", RayModel::kMip);
    addLayer("waves", RayModel::kIsosurface);
    expectSameInParts(2 + 3 * 4);
}

TEST_F(PicturesInParts, OfSlicesAreDrawnWhole) {
    scene_.layers[0].voxelEvaluator = scene::VoxelEvaluator::kSlices;
    expectSameInParts(1);
}

TEST_F(PicturesInParts, LetOtherViewsDrawBetweenTheirParts) {
    const Drawn whole = draw(scene_, kSize);
    EXPECT_FALSE(part(scene_, 2).info.finished);
    scene::Scene other = scene_;
    other.camera.eye.x = -20;
    const Drawn between = draw(other, {40, 30}, 3);
    EXPECT_NE(between.linear, whole.linear);
    const auto [drawn, parts] = allParts(scene_, 2);
    EXPECT_EQ(parts, 3) << "it went on where it was";
    EXPECT_EQ(drawn.linear, whole.linear);
}

TEST_F(PicturesInParts, EndWhereTheirViewDrawsAnother) {
    EXPECT_FALSE(part(scene_, 2).info.finished);
    scene::Scene turned = scene_;
    turned.camera.eye.x = -20;
    const Drawn next = draw(turned, kSize, 2);
    EXPECT_EQ(next.linear, draw(turned, kSize, 3).linear) << "nothing of the part is left";
    const auto [drawn, parts] = allParts(scene_, 2);
    EXPECT_EQ(parts, 4) << "from its beginning";
    EXPECT_EQ(drawn.linear, draw(scene_, kSize, 3).linear);
    EXPECT_FALSE(part(turned, 2).info.finished);
    EXPECT_EQ(allParts(scene_, 2).second, 4) << "another scene than the one that was begun";
}

TEST_F(PicturesInParts, BeginAnewWhenTheirDataChanges) {
    EXPECT_FALSE(part(scene_).info.finished);
    renderer_->addDataset("waves", support::volumeOf({.size = {12, 12, 12}, .origin = {-6, -6, -6}},
                                                     [](const auto&) { return 0.25; }));
    const auto [drawn, parts] = allParts(scene_);
    EXPECT_EQ(parts, 4);
    EXPECT_EQ(drawn.linear, draw(scene_, kSize, 3).linear);
}

}  // namespace
}  // namespace volcast
