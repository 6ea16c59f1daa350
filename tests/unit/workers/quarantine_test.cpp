// Code of users that is not run again.
#include "server/workers/quarantine.h"

#include <gmock/gmock.h>

namespace volcast::workers {
namespace {

using ::testing::HasSubstr;

scene::Scene running(const std::string& code, double control = 0.5) {
    scene::Layer plain, coded;
    plain.id = "plain";
    coded.id = "coded";
    coded.shader = {.code = code, .controls = {{.name = "s", .value = control}}};
    scene::Scene scene;
    scene.layers = {plain, coded};
    return scene;
}

TEST(Quarantine, HoldsCodeWithTheControlsItHad) {
    Quarantine quarantine;
    quarantine.add(running("a", 0.5));
    EXPECT_EQ(quarantine.find(running("a", 0.5)), 1U);
    EXPECT_FALSE(quarantine.find(running("a", 0.25)));
    EXPECT_FALSE(quarantine.find(running("b", 0.5)));
    scene::Scene moved = running("a", 0.5);
    moved.camera.eye.x += 1.0;
    EXPECT_TRUE(quarantine.find(moved)) << "from wherever it is seen";
}

TEST(Quarantine, LayersThatAreHiddenOrHaveNoCodeAreNoMatter) {
    Quarantine quarantine;
    scene::Scene hidden = running("a");
    hidden.layers[1].visible = false;
    EXPECT_FALSE(runsCode(hidden));
    quarantine.add(hidden);
    EXPECT_FALSE(quarantine.find(running("a")));
    quarantine.add(running("a"));
    EXPECT_FALSE(quarantine.find(hidden));
    scene::Scene plain = running("a");
    plain.layers.pop_back();
    EXPECT_FALSE(runsCode(plain));
    EXPECT_FALSE(quarantine.find(plain));
}

TEST(Quarantine, TheOldestIsForgiven) {
    Quarantine quarantine;
    for (std::size_t i = 0; i <= Quarantine::kMost; ++i) {
        quarantine.add(running("code " + std::to_string(i)));
        quarantine.add(running("code " + std::to_string(i)));
    }
    EXPECT_FALSE(quarantine.find(running("code 0")));
    EXPECT_TRUE(quarantine.find(running("code 1")));
}

TEST(Quarantine, TheErrorNamesLayerAndCode) {
    const scene::Scene scene =
        running("\n  #uicontrol float s slider(min=0, max=1)\nvoid main() {}");
    const Error error = quarantined(scene, 1, "it hung");
    EXPECT_EQ(error.code, ErrorCode::kDeviceLost);
    EXPECT_EQ(error.field, "layers[1].shader.code");
    EXPECT_THAT(error.message, HasSubstr("of layer \"coded\", which begins with \"#uicontrol float "
                                         "s slider(min=0, max=1)\""));
    EXPECT_THAT(error.message, HasSubstr("is not run again with these controls: it hung"));
}

}  // namespace
}  // namespace volcast::workers
