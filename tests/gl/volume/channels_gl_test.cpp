// Several channels that are drawn together, against sums over each one's samples in double.
#include <algorithm>
#include <cmath>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/volume/channel_sums.h"
#include "tests/gl/volume/channels_fixture.h"
#include "tests/support/edited_renderers.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

class Channels : public support::ChannelsTest {
protected:
    Channels() {
        inShader_->addDataset(
            "volume", support::channelsOf(support::kChannelsPlace, support::kChannelFields));
    }

    /// Every pixel is as far from the sum as float32 lets its samples be, and most are not far.
    void expectSums(const std::string& what, bool byTextureUnit = false) {
        constexpr glm::ivec2 kSize{24, 20};
        // Sums of 100 samples are rounded by 2^-24 each, their opacities as often.
        constexpr double kRounding = 2.0 * 100 / (1 << 24);
        const auto picture =
            support::must(tryDraw(byTextureUnit ? *renderer_ : *inShader_, scene_, kSize));
        const double shader = layer().sampling == Sampling::kTricubic
                                  ? support::ChannelSums::kTricubic
                                  : support::ChannelSums::kTrilinear;
        const double away =
            glm::length(scene_.camera.eye - scene_.camera.center) /
            std::min({support::kChannelsPlace.spacing.x, support::kChannelsPlace.spacing.y,
                      support::kChannelsPlace.spacing.z});
        const support::ChannelSums sums{
            layer(), alone_, away, byTextureUnit ? support::ChannelSums::kTextureUnit : shader};
        const support::VolumeReference box{alone_[0], Sampling::kTrilinear};
        double most = 0.0, worst = 0.0;
        std::vector<double> allowed;
        for (int y = 0; y < kSize.y; ++y) {
            for (int x = 0; x < kSize.x; ++x) {
                const auto ray = support::referenceRay(scene_.camera, kSize, x, y);
                const glm::dvec2 span = box.span(ray);
                // Along an edge of the box float32 may see it or not; the number of steps may
                // differ where the length is a multiple of one.
                const double steps = (span.y - span.x) / kStep;
                if (std::abs(span.y - span.x) < 1e-3 ||
                    std::abs(steps - std::round(steps)) < 1e-3) {
                    continue;
                }
                const auto wanted = sums.of(ray);
                const glm::dvec4 error = glm::abs(glm::dvec4(picture.at(x, y)) - wanted.pixel);
                const double off = std::max({error.r, error.g, error.b, error.a});
                EXPECT_LE(off, wanted.off + kRounding) << what << " at " << x << ' ' << y;
                if (span.x < span.y) allowed.push_back(wanted.off);
                worst = std::max(worst, off);
                most = std::max(most, static_cast<double>(picture.at(x, y).a));
            }
        }
        EXPECT_GT(most, 0.5) << what;
        ASSERT_GT(allowed.size(), 100U) << what;
        std::ranges::sort(allowed);
        // What is allowed is far below what an 8-bit picture shows, but for a few pixels.
        EXPECT_LT(allowed[allowed.size() / 2], 1e-3) << what;
        RecordProperty(what, std::to_string(worst) + " of " +
                                 std::to_string(allowed[allowed.size() / 2]) + " to " +
                                 std::to_string(allowed.back()));
    }

    std::unique_ptr<scene::Renderer> inShader_ = support::rendererWithoutTextureUnit(device());
};

TEST_F(Channels, EveryModelIsTheSumOfItsChannels) {
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kMip, RayModel::kMinip, RayModel::kXray}) {
        layer().model = model;
        expectSums(std::string{scene::name(model)});
        expectSums(std::string{scene::name(model)} + " by the texture unit", true);
    }
}

TEST_F(Channels, EverySamplingReadsAllChannels) {
    for (const Sampling sampling : {Sampling::kTricubic, Sampling::kNearest}) {
        layer().sampling = sampling;
        expectSums(std::string{scene::name(sampling)});
    }
}

TEST_F(Channels, EachIsLitByItsOwnSlope) {
    layer().light = scene::Light{};
    expectSums("from the eye");
    layer().light->position = glm::dvec3(2, 99, 4);
    expectSums("from a place");
    layer().gain = 0.5F;
    expectSums("with gain");
}

TEST_F(Channels, EachHasItsOwnInterval) {
    for (std::size_t i = 0; i < 4; ++i) {
        layer().channels[i].interval = support::kChannelIntervals[i];
    }
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray}) {
        layer().model = model;
        expectSums(std::string{scene::name(model)});
    }
}

TEST_F(Channels, OneOfThemIsTheChannelAlone) {
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kMip, RayModel::kMinip, RayModel::kXray}) {
        const bool volume = model == RayModel::kVolume;
        for (std::size_t shown = 0; shown < 3; ++shown) {
            for (std::size_t i = 0; i < 4; ++i) layer().channels[i].visible = i == shown;
            layer().model = model;
            layer().jitter = 5;
            layer().gain = volume ? 0.7F : 0.0F;
            layer().light = volume ? std::optional{scene::Light{}} : std::nullopt;
            scene::Scene alone = scene_;
            alone.layers[0].channels.clear();
            alone.layers[0].field = "c" + std::to_string(shown);
            alone.layers[0].map = support::channelMap(shown);
            alone.layers[0].interval = layer().channels[shown].interval =
                support::kChannelIntervals[shown];
            const auto one = draw(alone, {24, 20}), other = draw(scene_, {24, 20});
            // Both take the same values at the same places; maps are found in other ways, and
            // opacities are added up in another order: by rounding of each of 100 samples.
            constexpr float kRounding = 4.0F * 100 / (1 << 24);
            for (std::size_t i = 0; i < one.linear.size(); ++i) {
                ASSERT_NEAR(one.linear[i], other.linear[i], kRounding)
                    << scene::name(model) << " channel " << shown << ", value " << i;
            }
            for (const char* effect : {plan::kInterval, plan::kJitter}) {
                EXPECT_TRUE(other.info.plan.layers[0].has(effect)) << effect;
            }
            layer().channels[shown].interval.reset();
        }
    }
}

TEST_F(Channels, ConstantMatterObeysBeerLambertWithTheSumOfExtinctions) {
    for (std::size_t i = 0; i < 4; ++i) {
        layer().channels[i].map =
            support::constantMap({i == 0, i == 1, i == 2}, 0.05F * static_cast<float>(i + 1));
    }
    const auto picture = draw(scene_, {9, 9});
    const auto ray = support::referenceRay(scene_.camera, {9, 9}, 4, 4);
    const glm::dvec2 span = support::VolumeReference{alone_[0], Sampling::kTrilinear}.span(ray);
    const double alpha = -std::expm1(-0.5 * (span.y - span.x));
    EXPECT_NEAR(picture.at(4, 4).a, alpha, 1e-5);
    EXPECT_NEAR(picture.at(4, 4).r, alpha * 0.1, 1e-5);
    EXPECT_NEAR(picture.at(4, 4).g, alpha * 0.2, 1e-5);
    EXPECT_NEAR(picture.at(4, 4).b, alpha * 0.3, 1e-5);
}

TEST_F(Channels, AMapEditUploadsTheMapsAlone) {
    static_cast<void>(draw(scene_, {8, 8}));
    const auto before = renderer_->counters();
    layer().channels[1].map.points[0].colour.r = 0.9F;
    static_cast<void>(draw(scene_, {8, 8}));
    const auto after = renderer_->counters();
    EXPECT_EQ(after.textureUploads, before.textureUploads);
    EXPECT_EQ(after.programsBuilt, before.programsBuilt);
}

TEST_F(Channels, AllHiddenDrawNothing) {
    for (auto& channel : layer().channels) channel.visible = false;
    const auto picture = draw(scene_, {8, 8});
    EXPECT_EQ(picture.at(4, 4), glm::vec4(0.0F));
}

}  // namespace
}  // namespace volcast
