#include "renderer/accuracy/measurement_effects.h"

#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/plan/effects.h"

namespace volcast::accuracy {
namespace {

using Effects = std::set<std::string>;

scene::Scene sceneOf(std::vector<scene::Layer> layers) {
    scene::Scene scene;
    scene.layers = std::move(layers);
    return scene;
}

scene::Layer layer(const std::string& id, scene::RayModel model) {
    scene::Layer layer;
    layer.id = id;
    layer.model = model;
    layer.sampling = scene::Sampling::kNearest;
    return layer;
}

Effects effectsOf(const scene::Scene& scene) {
    Effects effects;
    for (const WithoutEffect& one : withoutEffects(scene)) {
        EXPECT_TRUE(effects.insert(one.layer + ": " + one.effect).second) << one.effect;
        EXPECT_NE(one.scene, scene) << one.effect;
        // Without it once more there is nothing to leave out.
        for (const WithoutEffect& again : withoutEffects(one.scene)) {
            EXPECT_FALSE(again.layer == one.layer && again.effect == one.effect) << one.effect;
        }
    }
    return effects;
}

TEST(WithoutEffects, AreThoseThatALayersSettingsAskFor) {
    scene::Scene scene = sceneOf({layer("v", scene::RayModel::kVolume)});
    EXPECT_EQ(effectsOf(scene), Effects{});
    scene::Layer& volume = scene.layers[0];
    volume.interval = data::Range{0.0F, 1.0F};
    volume.densityField = "g";
    volume.scale.kind = scene::Scale::Kind::kLog;
    volume.markers.field = "part";
    volume.light.emplace();
    volume.jitter = 3;
    volume.sampling = scene::Sampling::kTrilinear;
    EXPECT_EQ(effectsOf(scene),
              (Effects{"v: interval", "v: second field", "v: scale", "v: cells left out",
                       "v: light", "v: jitter", "v: interpolation"}));
}

TEST(WithoutEffects, OfBoundariesAndLevelsAreTheirOwn) {
    scene::Scene scene = sceneOf(
        {layer("w", scene::RayModel::kWireframe), layer("i", scene::RayModel::kIsosurface)});
    scene.layers[0].coloured = true;
    scene.layers[1].coloured = true;
    EXPECT_EQ(effectsOf(scene),
              (Effects{"w: headlight", "w: edges", "w: colour by value", "i: gradient"}));
}

TEST(WithoutEffects, ClipPlanesGoForEachLayerThatIsDrawnByUs) {
    scene::Scene scene =
        sceneOf({layer("a", scene::RayModel::kMip), layer("hidden", scene::RayModel::kMip),
                 layer("code", scene::RayModel::kMip)});
    scene.clipPlanes.resize(2);
    scene.layers[1].visible = false;
    scene.layers[2].shader.code = "void main() {}";
    EXPECT_EQ(effectsOf(scene), Effects{"a: clip planes"});
    EXPECT_TRUE(withoutEffects(scene)[0].scene.clipPlanes.empty());
}

}  // namespace
}  // namespace volcast::accuracy
