// Picking against pictures: the value that a pixel shows is the value that is picked there.
#include <cmath>

#include "renderer/pick/picker.h"
#include "renderer/plan/effects.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;

constexpr glm::ivec2 kSize{24, 18};

class PickAgainstPicture : public support::RenderTest {
protected:
    PickAgainstPicture() {
        dataset_ = support::volumeOf({.size = {17, 13, 15}}, [](const glm::dvec3& p) {
            return 0.5 + 0.4 * std::sin(0.5 * p.x + 0.3 * p.y) * std::cos(0.4 * p.z);
        });
        renderer_->addDataset("volume", std::get<data::Volume>(dataset_));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = {{{.value = 0.0F, .colour = glm::vec3(0.0F), .extinction = 1.0F},
                      {.value = 1.0F, .colour = glm::vec3(1.0F), .extinction = 1.0F}}};
        layer.stepWorld = 1.3;  // Samples lie apart: where they are decides.
        layer.jitter = 0x12345678U;
        scene_.layers.push_back(layer);
        scene_.camera = {.eye = {40, 30, 35}, .center = {8, 6, 7}, .fovyDegrees = 20};
    }

    data::Dataset dataset_;
    scene::Scene scene_;
    pick::Picker picker_;
};

TEST_F(PickAgainstPicture, JitteredSamplesAreTheOnesThatArePicked) {
    for (const RayModel model : {RayModel::kMip, RayModel::kMinip}) {
        scene_.layers[0].model = model;
        const auto drawn = draw(scene_, kSize);
        ASSERT_TRUE(drawn.info.plan.layers[0].has(plan::kJitter));
        int compared = 0, middle = 0;
        for (int y = 0; y < kSize.y; ++y) {
            for (int x = 0; x < kSize.x; ++x) {
                const auto valueOf = [&](const scene::Scene& scene) {
                    const auto picked =
                        picker_.pick(scene, kSize, {x, y}, [&](auto&) { return &dataset_; });
                    EXPECT_TRUE(picked.has_value());
                    return picked && *picked ? (*picked)->values.at(0).value : 0.0;
                };
                scene::Scene unmoved = scene_;
                unmoved.layers[0].jitter.reset();
                const double value = valueOf(scene_), other = valueOf(unmoved);
                // The map is the value as a grey; float32 rounds places of up to 60 by 2^-19.
                EXPECT_NEAR(drawn.at(x, y).r, value, 2e-5) << x << ' ' << y;
                compared += drawn.at(x, y).a > 0.0F ? 1 : 0;
                middle += std::abs(other - value) < 2e-5 ? 1 : 0;
            }
        }
        EXPECT_GT(compared, kSize.x * kSize.y / 4);
        EXPECT_LT(middle, kSize.x * kSize.y - compared / 2) << "samples in the middle differ";
    }
}

}  // namespace
}  // namespace volcast
