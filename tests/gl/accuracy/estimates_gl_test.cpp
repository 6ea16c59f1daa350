// What pictures of voxels are estimated to take, before any of them is measured.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/accuracy/evidence.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/mesh_scenes.h"
#include "tests/support/phantoms.h"

namespace volcast::accuracy {
namespace {

using support::must;

class EstimatesTest : public support::RenderTest {
protected:
    EstimatesTest() {
        renderer_->addDataset("waves", waves());
        scene_.camera = support::perspective({40, 30, 50}, glm::dvec3{8.0});
        scene_.accuracy = {.kind = scene::Accuracy::Kind::kTimeBudget, .bound = 20.0};
        scene::Layer& layer = scene_.layers.emplace_back();
        layer.id = "waves";
        layer.dataset = "waves";
        layer.map = support::ruler(-1.0F, 1.0F, 0.1F);
    }

    static data::Volume waves() {
        return support::volumeOf({.size = {17, 17, 17}},
                                 [](const auto& p) { return std::sin(0.7 * p.x + 0.4 * p.y); });
    }

    std::optional<plan::SceneEvidence> nextPart() {
        return must(keeper_.advanceEstimates(scene_, kSize));
    }

    static constexpr scene::PictureSize kSize{320, 200};
    scene::Scene scene_;
    Meter meter_{*renderer_};
    EvidenceKeeper keeper_{*renderer_, meter_, Costs{"", "this one"}};
};

TEST_F(EstimatesTest, ComeInPartsOfOnePictureSoThatOtherViewsAreDrawnBetween) {
    int parts = 0;
    std::optional<plan::SceneEvidence> found;
    while (!found) {
        const std::uint64_t before = renderer_->counters().framesDrawn;
        found = nextPart();
        EXPECT_LE(renderer_->counters().framesDrawn, before + 1);
        ASSERT_LT(++parts, 100);
        // Another view's picture.
        static_cast<void>(draw(scene_, {24, 16}));
    }
    const auto ways = scene::row(scene_.layers[0].model).integratorsOf(false);
    ASSERT_EQ(found->at("waves").size(), ways.size());
    for (const plan::Evidence& way : found->at("waves")) {
        EXPECT_GT(way.predictedMs.value_or(0.0), 0.0);
    }
    EXPECT_GE(parts, static_cast<int>(2 * ways.size()));
    EXPECT_FALSE(nextPart().has_value()) << "what voxels take is not kept";
}

TEST_F(EstimatesTest, BeginAnewForAnotherSceneAndForOtherData) {
    EXPECT_FALSE(nextPart().has_value());
    scene_.layers[0].id = "the same by another name";
    EXPECT_FALSE(nextPart().has_value());
    meter_.forget("waves");
    keeper_.forget("waves");
    renderer_->addDataset("waves", waves());
    std::optional<plan::SceneEvidence> found;
    for (int parts = 0; !found && parts < 100; ++parts) found = nextPart();
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->contains("the same by another name"));
}

}  // namespace
}  // namespace volcast::accuracy
