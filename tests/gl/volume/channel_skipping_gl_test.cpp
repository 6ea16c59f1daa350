// Channels that are drawn together pass over what shows nothing of any of them.
#include <algorithm>
#include <cmath>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/volume/channels_fixture.h"
#include "tests/support/edited_renderers.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

/// Two small blobs in much emptiness, and a ramp.
data::Volume sparse() {
    const support::GridPlace place{.size = {60, 40, 50},
                                   .spacing = support::kChannelsPlace.spacing * 0.35,
                                   .origin = support::kChannelsPlace.origin,
                                   .direction = support::kChannelsPlace.direction};
    return support::channelsOf(place, {{"left",
                                        [](auto p) {
                                            return support::blob(p, {14, 20, 20}, 5.0);
                                        }},
                                       {"right",
                                        [](auto p) {
                                            return support::blob(p, {44, 24, 30}, 6.0);
                                        }},
                                       {"ramp", [](auto p) { return p.x; }}});
}

data::TransferFunction hump() {
    return {{{.value = 0.3F, .colour = {0.2F, 0.3F, 0.9F}, .extinction = 0.0F},
             {.value = 0.9F, .colour = {1, 0.5F, 0}, .extinction = 0.9F}}};
}

class ChannelSkipping : public support::ChannelsTest {
protected:
    const plan::Effect& emptyBricks(const support::Drawn& drawn) {
        const auto& effects = drawn.info.plan.layers[0].effects;
        return *std::ranges::find(effects, plan::kEmptyBricks, &plan::Effect::name);
    }
};

TEST_F(ChannelSkipping, DrawsWhatIsDrawnWithoutIt) {
    const auto passingOverNothing = support::rendererWithoutSkipping(device());
    for (scene::Renderer* each : {renderer_.get(), passingOverNothing.get()}) {
        each->addDataset("volume", sparse());
    }
    layer().stepWorld = 0.05;
    layer().channels = {{.field = "left", .map = hump()}, {.field = "right", .map = hump()}};
    for (const Sampling sampling :
         {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
        for (const RayModel model :
             {RayModel::kVolume, RayModel::kXray, RayModel::kMip, RayModel::kMinip}) {
            for (int variant = 0; variant < 3; ++variant) {
                layer().sampling = sampling;
                layer().model = model;
                layer().jitter = variant == 1 ? std::optional{7U} : std::nullopt;
                layer().light.reset();
                if (variant == 1 && model == RayModel::kVolume) layer().light = scene::Light{};
                layer().channels[0].interval.reset();
                if (variant == 2) layer().channels[0].interval = data::Range{0.35F, 0.8F};
                const auto passed = draw(scene_, {40, 30});
                const auto all = support::must(tryDraw(*passingOverNothing, scene_, {40, 30}));
                EXPECT_TRUE(emptyBricks(passed).on) << name(model);
                EXPECT_EQ(passed.linear, all.linear)
                    << name(model) << ' ' << name(sampling) << ' ' << variant;
                EXPECT_GT(*std::ranges::max_element(passed.linear), 0.1F);
            }
        }
    }
}

TEST_F(ChannelSkipping, OneChannelThatShowsEverywhereLeavesNothingToPassOver) {
    renderer_->addDataset("volume", sparse());
    layer().channels = {{.field = "left", .map = hump()}, {.field = "right", .map = hump()}};
    EXPECT_EQ(emptyBricks(draw(scene_, {8, 8})).reason,
              "a brick is passed over where no channel's map has extinction");
    layer().channels.push_back({.field = "ramp", .map = support::constantMap({}, 1e-30F)});
    const auto visiting = draw(scene_, {8, 8});
    EXPECT_FALSE(emptyBricks(visiting).on);
    EXPECT_EQ(emptyBricks(visiting).reason,
              "a channel's map has extinction everywhere in the data's range");
    EXPECT_EQ(visiting.info.work.bufferUploads, 2U) << "the maps and the blocks";
}

TEST_F(ChannelSkipping, VoxelsWithoutAValueAreMissingInTheirChannelAlone) {
    const double nan = std::nan("");
    const auto hole = [&](const glm::dvec3& p) {
        return glm::length(p - glm::dvec3(9, 7, 11)) < 4;
    };
    renderer_->addDataset(
        "volume",
        support::channelsOf({.size = support::kChannelsPlace.size},
                            {{"holed", [&](const glm::dvec3& p) { return hole(p) ? nan : 5.0; }},
                             {"whole", [](const glm::dvec3&) { return 2.0; }}}));
    layer().channels = {{.field = "holed", .map = support::constantMap({1, 0, 0}, 0.3F)},
                        {.field = "whole", .map = support::constantMap({0, 1, 0}, 0.2F)}};
    scene_.camera = {.eye = {9, 7, -50}, .center = {9, 7, 11}, .up = {0, 1, 0}};
    scene_.camera.projection = scene::Projection::kOrthographic;
    scene_.camera.orthographicHeight = 4.0;
    const auto drawn = draw(scene_, {1, 1});
    // Along the middle of 22 intervals points 8 to 14 are missing: cells from 7 to 15.
    const double whole = 0.2 * 22, holed = 0.3 * (22 - 8);
    // Its ends lie within steps of 0.11.
    EXPECT_NEAR(drawn.at(0, 0).a, -std::expm1(-whole - holed), 2 * 0.11 * 0.3 * std::exp(-whole));
    layer().model = RayModel::kXray;
    layer().extinctionScale = 0.1F;
    EXPECT_NEAR(draw(scene_, {1, 1}).at(0, 0).r, std::exp(-0.1 * (whole + holed)),
                0.1 * 0.11 * 0.3);
    layer().model = RayModel::kMip;
    layer().light.reset();
    EXPECT_EQ(draw(scene_, {1, 1}).at(0, 0), glm::vec4(1, 1, 0, 1));
    layer().channels[0].interval = data::Range{.min = 6.0F, .max = 7.0F};
    EXPECT_EQ(draw(scene_, {1, 1}).at(0, 0), glm::vec4(0, 1, 0, 1)) << "no value of it counts";
    layer().channels[1].interval = data::Range{.min = 6.0F, .max = 7.0F};
    EXPECT_EQ(draw(scene_, {1, 1}).at(0, 0), glm::vec4(0.0F)) << "nor of any";
}

}  // namespace
}  // namespace volcast
