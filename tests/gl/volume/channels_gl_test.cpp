// Several channels that are drawn together, against sums over each one's samples in double.
#include <algorithm>
#include <cmath>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

const support::GridPlace kPlace{.size = {19, 14, 23},
                                .spacing = {0.4, 0.7, 0.3},
                                .origin = {-3.0, 90.0, 5.0},
                                .direction = support::turn({2, -1, 1}, 63.0)};

double blob(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
    const glm::dvec3 d = (p - centre) / radius;
    return std::exp(-glm::dot(d, d));
}

const std::vector<std::function<double(const glm::dvec3&)>> kFields{
    [](const glm::dvec3& p) {
        return 80.0 * blob(p, {7, 6, 8}, 5.0);
    },
    [](const glm::dvec3& p) {
        return 3.0 * blob(p, {11, 8, 14}, 6.0) - 1.0;
    },
    [](const glm::dvec3& p) { return std::sin(p.x) + 0.1 * p.z; },
    [](const glm::dvec3& p) { return p.x * p.y / 100.0; }};

/// Few points and many of them, so that every way to find a value is met.
data::TransferFunction mapOf(std::size_t channel) {
    switch (channel) {
        case 0:
            return {{{.value = 10.0F, .colour = {1, 0, 0}, .extinction = 0.0F},
                     {.value = 60.0F, .colour = {1, 0.5F, 0}, .extinction = 0.9F}}};
        case 1: {
            data::TransferFunction map;
            for (int i = 0; i < 60; ++i) {
                const float t = static_cast<float>(i) / 59.0F;
                map.points.push_back({.value = -1.0F + 3.0F * t,
                                      .colour = {0, t, 1.0F - t},
                                      .extinction = 0.3F * t * t});
            }
            return map;
        }
        case 2: {
            data::TransferFunction map;
            for (int i = 0; i < 40; ++i) {  // Too uneven for a grid.
                const float t = std::exp2(static_cast<float>(i) - 37.0F);
                map.points.push_back(
                    {.value = t, .colour = {0, 0, std::min(t, 1.0F)}, .extinction = 0.05F * t});
            }
            return map;
        }
        default:
            return {{{.value = 0.5F, .colour = {0.1F, 0.2F, 0.3F}, .extinction = 0.1F},
                     {.value = 0.5F, .colour = {0.3F, 0.1F, 0.1F}, .extinction = 0.4F}}};
    }
}

/// Within the values of each channel.
constexpr data::Range kIntervals[4] = {{.min = 20.0F, .max = 70.0F},
                                       {.min = -0.5F, .max = 1.5F},
                                       {.min = 0.25F, .max = 2.0F},
                                       {.min = 0.1F, .max = 1.0F}};

class Channels : public support::RenderTest {
protected:
    Channels() {
        data::VolumeInput input;
        input.size = kPlace.size;
        input.spacing = kPlace.spacing;
        input.origin = kPlace.origin;
        input.direction = kPlace.direction;
        for (std::size_t i = 0; i < kFields.size(); ++i) {
            alone_.push_back(support::volumeOf(kPlace, kFields[i]));
            const auto bytes = alone_.back().channels[0].voxels.span();
            input.channels.push_back({.name = "c" + std::to_string(i),
                                      .unit = "",
                                      .voxels = {bytes.begin(), bytes.end()}});
        }
        renderer_->addDataset("volume", support::must(data::buildVolume(std::move(input))));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = mapOf(0);
        layer.stepWorld = 0.11;
        for (std::size_t i = 0; i < kFields.size(); ++i) {
            layer.channels.push_back({.field = "c" + std::to_string(i), .map = mapOf(i)});
        }
        scene_.layers.push_back(layer);
        const glm::dvec3 centre =
            kPlace.origin + kPlace.direction * (0.5 * kPlace.spacing * glm::dvec3(kPlace.size - 1));
        scene_.camera = {.eye = centre + glm::dvec3(11, 7, 9), .center = centre};
    }

    [[nodiscard]] scene::Layer& layer() { return scene_.layers[0]; }

    /// What the ray of a pixel gathers of the channels that are shown.
    [[nodiscard]] glm::dvec4 expected(const support::ReferenceRay& ray) const {
        const scene::Layer& layer = scene_.layers[0];
        std::vector<std::size_t> shown;
        for (std::size_t i = 0; i < layer.channels.size(); ++i) {
            if (layer.channels[i].visible) shown.push_back(i);
        }
        const support::VolumeReference first{alone_[0], layer.sampling};
        const glm::dvec2 span = first.span(ray);
        const bool xray = layer.model == RayModel::kXray;
        if (span.x > span.y) return xray ? glm::dvec4(1.0) : glm::dvec4(0.0);
        const int steps = std::max(1, static_cast<int>(std::ceil((span.y - span.x) / 0.11)));
        const double dt = (span.y - span.x) / steps;
        std::vector<std::vector<double>> values;
        for (const std::size_t c : shown) {
            values.push_back(
                support::VolumeReference{alone_[c], layer.sampling}.valuesOn(ray, steps));
        }
        // Of the channel's own light, and only of values in its interval.
        const auto matter = [&](std::size_t k, double value, double distance = 0.0) {
            const scene::ChannelMap& channel = layer.channels[shown[k]];
            const auto& interval = channel.interval;
            if (interval && !(value >= interval->min && value <= interval->max)) {
                return glm::dvec4(0.0);
            }
            glm::dvec4 m = support::VolumeReference::matterOf(value, channel.map);
            if (layer.model == RayModel::kVolume) m.a *= std::exp(layer.gain);
            if (!layer.light) return m;
            const support::VolumeReference field{alone_[shown[k]], layer.sampling};
            const glm::dvec3 at = ray.eye + distance * ray.direction;
            return glm::dvec4(field.lit(glm::dvec3(m), *layer.light, at, ray.direction), m.a);
        };
        if (layer.model == RayModel::kMip || layer.model == RayModel::kMinip) {
            glm::dvec3 colour{0.0};
            for (std::size_t k = 0; k < shown.size(); ++k) {
                const auto [low, high] = std::ranges::minmax(values[k]);
                colour += glm::dvec3(matter(k, layer.model == RayModel::kMip ? high : low));
            }
            return {colour, 1.0};
        }
        glm::dvec3 colour{0.0};
        double depth = 0.0;
        for (int i = 0; i < steps; ++i) {
            glm::dvec3 emission{0.0};
            double extinction = 0.0;
            for (std::size_t k = 0; k < shown.size(); ++k) {
                const glm::dvec4 m =
                    matter(k, values[k][static_cast<std::size_t>(i)], span.x + (i + 0.5) * dt);
                emission += glm::dvec3(m) * m.a;
                extinction += m.a;
            }
            if (extinction > 0.0) {
                colour += std::exp(-depth) * -std::expm1(-extinction * dt) * emission / extinction;
            }
            depth += extinction * dt;
        }
        if (xray) return {glm::dvec3(std::exp(-layer.extinctionScale * depth)), 1.0};
        return {colour, -std::expm1(-depth)};
    }

    void expectSums(double tolerance) {
        constexpr glm::ivec2 kSize{24, 20};
        const auto picture = draw(scene_, kSize);
        const support::VolumeReference box{alone_[0], Sampling::kTrilinear};
        double worst = 0.0, most = 0.0;
        for (int y = 0; y < kSize.y; ++y) {
            for (int x = 0; x < kSize.x; ++x) {
                const auto ray = support::referenceRay(scene_.camera, kSize, x, y);
                const glm::dvec2 span = box.span(ray);
                // Along an edge of the box float32 may see it or not; the number of steps may
                // differ where the length is a multiple of one.
                const double steps = (span.y - span.x) / 0.11;
                if (std::abs(span.y - span.x) < 1e-3 ||
                    std::abs(steps - std::round(steps)) < 1e-3) {
                    continue;
                }
                const glm::dvec4 error = glm::abs(glm::dvec4(picture.at(x, y)) - expected(ray));
                worst = std::max({worst, error.r, error.g, error.b, error.a});
                most = std::max(most, static_cast<double>(picture.at(x, y).a));
            }
        }
        EXPECT_LT(worst, tolerance) << scene::name(layer().model);
        EXPECT_GT(most, 0.5);
    }

    using Field = std::pair<std::string, std::function<double(const glm::dvec3&)>>;
    static data::Volume channelsOf(const support::GridPlace& place,
                                   const std::vector<Field>& fields) {
        data::VolumeInput input;
        input.size = place.size;
        input.spacing = place.spacing;
        input.origin = place.origin;
        input.direction = place.direction;
        for (const auto& [name, value] : fields) {
            const data::Volume alone = support::volumeOf(place, value);
            const auto bytes = alone.channels[0].voxels.span();
            input.channels.push_back(
                {.name = name, .unit = "", .voxels = {bytes.begin(), bytes.end()}});
        }
        return support::must(data::buildVolume(std::move(input)));
    }

    /// Two small blobs in much emptiness, and a ramp.
    static data::Volume sparse() {
        const support::GridPlace place{.size = {60, 40, 50},
                                       .spacing = kPlace.spacing * 0.35,
                                       .origin = kPlace.origin,
                                       .direction = kPlace.direction};
        return channelsOf(place, {{"left",
                                   [](auto p) {
                                       return blob(p, {14, 20, 20}, 5.0);
                                   }},
                                  {"right",
                                   [](auto p) {
                                       return blob(p, {44, 24, 30}, 6.0);
                                   }},
                                  {"ramp", [](auto p) { return p.x; }}});
    }
    static data::TransferFunction hump() {
        return {{{.value = 0.3F, .colour = {0.2F, 0.3F, 0.9F}, .extinction = 0.0F},
                 {.value = 0.9F, .colour = {1, 0.5F, 0}, .extinction = 0.9F}}};
    }

    std::vector<data::Volume> alone_;
    scene::Scene scene_;
};

TEST_F(Channels, EveryModelIsTheSumOfItsChannels) {
    // Values are float32 sums of 8 voxels up to 80 and slopes of maps are up to 0.4 of colour a
    // unit, over at most 100 samples: 80 * 2^-22 * 0.4 * 100 = 8e-4 at the very worst. The map with
    // a step stays out: a sample beside the step may fall on its other side.
    layer().channels[3].visible = false;
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kMip, RayModel::kMinip, RayModel::kXray}) {
        layer().model = model;
        expectSums(8e-4);
    }
}

TEST_F(Channels, EverySamplingReadsAllChannels) {
    layer().channels[3].visible = false;
    layer().sampling = Sampling::kTricubic;
    expectSums(8e-4);
    layer().sampling = Sampling::kNearest;
    // A sample midway between voxels may take the other one: 1 of 100 of a pixel's light.
    expectSums(2e-2);
}

// Where a channel is nearly flat rounding turns its normal, and with it a sample's light.
TEST_F(Channels, EachIsLitByItsOwnSlope) {
    layer().channels[3].visible = false;
    for (const auto& place : {std::optional<glm::dvec3>{}, std::optional{glm::dvec3(2, 99, 4)}}) {
        layer().light = scene::Light{.position = place};
        expectSums(2e-3);
    }
    layer().gain = 0.5F;
    expectSums(2e-3);
}

// A value beside an end of an interval may count or not: a hundredth of a ray.
TEST_F(Channels, EachHasItsOwnInterval) {
    layer().channels[3].visible = false;
    for (std::size_t i = 0; i < 3; ++i) layer().channels[i].interval = kIntervals[i];
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray}) {
        layer().model = model;
        expectSums(2e-2);
    }
}

// What is passed over adds nothing: an optical depth of 1e-30 a unit, as the other picture has it
// everywhere, does not show in float32.
TEST_F(Channels, BlocksWhereNoChannelAddsAnythingArePassedOver) {
    renderer_->addDataset("volume", sparse());
    layer().stepWorld = 0.05;
    for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
        for (const RayModel model :
             {RayModel::kVolume, RayModel::kXray, RayModel::kMip, RayModel::kMinip}) {
            layer().sampling = sampling;
            layer().model = model;
            layer().channels = {{.field = "left", .map = hump()},
                                {.field = "right", .map = hump()}};
            const auto skipping = draw(scene_, {40, 30});
            EXPECT_TRUE(skipping.info.plan.layers[0].has(plan::kEmptyBricks)) << name(model);
            // The same with nothing to skip by: matter that does not show, everywhere.
            layer().channels.push_back({.field = "ramp", .map = support::constantMap({}, 1e-30F)});
            const auto visiting = draw(scene_, {40, 30});
            const bool absorbs = model == RayModel::kVolume || model == RayModel::kXray;
            if (absorbs) {
                EXPECT_FALSE(visiting.info.plan.layers[0].has(plan::kEmptyBricks));
            }
            double worst = 0.0;
            for (std::size_t i = 0; i < skipping.linear.size(); ++i) {
                worst = std::max(worst, std::abs(double{skipping.linear[i]} - visiting.linear[i]));
            }
            EXPECT_LE(worst, 1e-6) << name(model);
            EXPECT_GT(*std::ranges::max_element(skipping.linear), 0.1F);
        }
    }
}

TEST_F(Channels, VoxelsWithoutAValueAreMissingInTheirChannelAlone) {
    const double nan = std::nan("");
    const auto hole = [&](const glm::dvec3& p) {
        return glm::length(p - glm::dvec3(9, 7, 11)) < 4;
    };
    renderer_->addDataset(
        "volume", channelsOf({.size = kPlace.size},
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

TEST_F(Channels, OneOfThemIsTheChannelAlone) {
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kMip, RayModel::kMinip, RayModel::kXray}) {
        for (std::size_t shown = 0; shown < 3; ++shown) {
            scene::Scene alone = scene_;
            alone.layers[0].channels.clear();
            alone.layers[0].field = "c" + std::to_string(shown);
            alone.layers[0].map = mapOf(shown);
            alone.layers[0].model = layer().model = model;
            for (std::size_t i = 0; i < 4; ++i) layer().channels[i].visible = i == shown;
            for (scene::Scene* each : {&alone, &scene_}) {
                each->layers[0].jitter = 5;
                each->layers[0].gain = model == RayModel::kVolume ? 0.7F : 0.0F;
                if (model == RayModel::kVolume) each->layers[0].light = scene::Light{};
            }
            const data::Range interval = kIntervals[shown];
            alone.layers[0].interval = layer().channels[shown].interval = interval;
            float worst = 0.0F;
            int off = 0;
            const auto one = draw(alone, {24, 20}), other = draw(scene_, {24, 20});
            for (int y = 0; y < 20; ++y) {
                for (int x = 0; x < 24; ++x) {
                    for (int c = 0; c < 4; ++c) {
                        worst = std::max(worst, std::abs(one.at(x, y)[c] - other.at(x, y)[c]));
                        off += std::abs(one.at(x, y)[c] - other.at(x, y)[c]) > 8e-4F ? 1 : 0;
                    }
                }
            }
            // A value beside an end of the interval may count for one of them.
            EXPECT_LT(off, 5) << scene::name(model) << " channel " << shown;
            layer().light.reset();
            layer().jitter.reset();
            layer().gain = 0.0F;
            EXPECT_LT(worst, 2e-2F) << scene::name(model) << " channel " << shown;
            for (const char* effect : {plan::kInterval, plan::kJitter}) {
                EXPECT_TRUE(other.info.plan.layers[0].has(effect)) << effect;
            }
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
