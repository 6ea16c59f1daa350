#include "renderer/scene/validate.h"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "gtest/gtest.h"

#include "renderer/scene/default_scene.h"

namespace volcast::scene {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

data::DatasetSummary meshSummary() {
    data::DatasetSummary summary;
    summary.bounds = {.min = {0, 0, 0}, .max = {1, 2, 3}};
    data::FieldSummary field;
    field.name = "heat";
    field.range = {.min = -1.0F, .max = 5.0F};
    field.steps = 3;
    summary.fields.push_back(field);
    return summary;
}

data::DatasetSummary volumeSummary() {
    data::DatasetSummary summary = meshSummary();
    summary.isMesh = false;
    summary.fields[0].steps = 1;
    return summary;
}

Scene sceneOf(const data::DatasetSummary& summary) {
    return defaultScene("data", summary);
}

struct Refusal {
    ErrorCode code;
    std::string field;
    friend bool operator==(const Refusal&, const Refusal&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
        return out << name(refusal.code) << " at " << refusal.field;
    }
};

Refusal refusalOf(const Result<void>& result) {
    if (result) return {ErrorCode::kInvalidArgument, "nothing was refused"};
    return {result.error().code, result.error().field};
}

TEST(ValidateScene, DefaultScenesAreValid) {
    for (const auto& summary : {meshSummary(), volumeSummary()}) {
        const Scene scene = sceneOf(summary);
        EXPECT_TRUE(validate(scene).has_value());
        EXPECT_TRUE(validate(scene, {{"data", summary}}).has_value());
        EXPECT_EQ(scene.layers.at(0).model, RayModel::kVolume);
        EXPECT_EQ(scene.layers[0].field, "heat");
    }
    data::DatasetSummary bare = meshSummary();
    bare.fields.clear();
    const Scene scene = sceneOf(bare);
    EXPECT_EQ(scene.layers.at(0).model, RayModel::kSurface);
    EXPECT_TRUE(validate(scene).has_value());
    EXPECT_TRUE(validate(scene, {{"data", bare}}).has_value());
}

TEST(ValidateScene, NamesTheFieldAtFault) {
    const auto refused = [](auto edit) {
        Scene scene = sceneOf(meshSummary());
        edit(scene);
        return refusalOf(validate(scene));
    };
    const auto invalid = ErrorCode::kInvalidArgument;
    EXPECT_EQ(refused([](Scene& s) { s.camera.up.y = kNan; }), (Refusal{invalid, "camera.up"}));
    EXPECT_EQ(refused([](Scene& s) { s.background.g = kNan; }), (Refusal{invalid, "background"}));
    EXPECT_EQ(refused([](Scene& s) { s.background.a = 1.5F; }),
              (Refusal{invalid, "background_transparency"}));
    EXPECT_EQ(refused([](Scene& s) { s.background.a = kNan; }),
              (Refusal{invalid, "background_transparency"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers.push_back(s.layers[0]); }),
              (Refusal{invalid, "layers[1].id"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers.resize(17, s.layers[0]); }),
              (Refusal{ErrorCode::kLimitExceeded, "layers"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].stepWorld = -1; }),
              (Refusal{invalid, "layers[0].step_world"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].stepWorld = kNan; }),
              (Refusal{invalid, "layers[0].step_world"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].surfaceColour.b = kNan; }),
              (Refusal{invalid, "layers[0].surface_colour"}));
    for (const data::Range wrong :
         {data::Range{.min = 2.0F, .max = 1.0F}, data::Range{.min = kNan, .max = 1.0F},
          data::Range{.min = 0.0F, .max = HUGE_VALF}}) {
        EXPECT_EQ(refused([&](Scene& s) { s.layers[0].interval = wrong; }),
                  (Refusal{invalid, "layers[0].interval"}));
    }
    Scene oneValue = sceneOf(meshSummary());  // An interval of width 0 is that value.
    oneValue.layers[0].interval = data::Range{.min = 2.0F, .max = 2.0F};
    EXPECT_TRUE(validate(oneValue).has_value());
    const auto refusedLight = [&](auto edit) {
        return refused([&](Scene& s) { edit(s.layers[0].light.emplace()); });
    };
    EXPECT_EQ(refusedLight([](Light& l) { l.ambient = -0.1F; }),
              (Refusal{invalid, "layers[0].light.ambient"}));
    EXPECT_EQ(refusedLight([](Light& l) { l.diffuse = kNan; }),
              (Refusal{invalid, "layers[0].light.diffuse"}));
    EXPECT_EQ(refusedLight([](Light& l) { l.specular = std::numeric_limits<float>::infinity(); }),
              (Refusal{invalid, "layers[0].light.specular"}));
    EXPECT_EQ(refusedLight([](Light& l) { l.exponent = 0.0F; }),
              (Refusal{invalid, "layers[0].light.exponent"}));
    EXPECT_EQ(refusedLight([](Light& l) { l.position = glm::dvec3(0, kNan, 0); }),
              (Refusal{invalid, "layers[0].light.position"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].timeStep = -1; }),
              (Refusal{invalid, "layers[0].time_step"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].map.points.clear(); }),
              (Refusal{invalid, "layers[0].transfer_function.points"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].map.points[1].value = -1e9F; }),
              (Refusal{invalid, "layers[0].transfer_function.points[1].value"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].map.points[1].extinction = -1.0F; }),
              (Refusal{invalid, "layers[0].transfer_function.points[1].extinction"}));
    EXPECT_EQ(refused([](Scene& s) { s.layers[0].map.points.resize(1025); }),
              (Refusal{ErrorCode::kLimitExceeded, "layers[0].transfer_function.points"}));
}

TEST(ValidateScene, AgainstItsData) {
    const auto refused = [](const data::DatasetSummary& summary, auto edit) {
        Scene scene = sceneOf(summary);
        edit(scene.layers[0]);
        return refusalOf(validate(scene, {{"data", summary}}));
    };
    EXPECT_EQ(refused(meshSummary(), [](Layer& l) { l.dataset = "gone"; }),
              (Refusal{ErrorCode::kNotFound, "layers[0].dataset"}));
    EXPECT_EQ(refused(meshSummary(), [](Layer& l) { l.field = "gone"; }),
              (Refusal{ErrorCode::kNotFound, "layers[0].field"}));
    EXPECT_EQ(refused(meshSummary(), [](Layer& l) { l.timeStep = 3; }),
              (Refusal{ErrorCode::kInvalidArgument, "layers[0].time_step"}));
    EXPECT_EQ(refused(meshSummary(), [](Layer& l) { l.scale.domain = {.min = 1.0F, .max = 1.0F}; }),
              (Refusal{ErrorCode::kInvalidArgument, "layers[0].scale.domain"}));
    EXPECT_EQ(refused(volumeSummary(), [](Layer& l) { l.model = RayModel::kSurface; }),
              (Refusal{ErrorCode::kUnsupported, "layers[0].model"}));
    for (const auto& [field, edit] :
         std::initializer_list<std::pair<const char*, void (*)(Layer&)>>{
             {"layers[0].density_field", [](Layer& l) { l.densityField = "f"; }},
             {"layers[0].scale", [](Layer& l) { l.scale.kind = Scale::Kind::kLog; }},
             {"layers[0].scale", [](Layer& l) { l.scale.domain = {.min = 1.0F, .max = 2.0F}; }},
             {"layers[0].markers.field",
              [](Layer& l) { l.markers = {.field = "f", .values = {1.0F}}; }}}) {
        EXPECT_EQ(refused(volumeSummary(), edit), (Refusal{ErrorCode::kUnsupported, field}));
    }
    data::DatasetSummary bare = meshSummary();
    bare.fields.clear();
    EXPECT_EQ(refused(bare, [](Layer& l) { l.model = RayModel::kVolume; }),
              (Refusal{ErrorCode::kInvalidArgument, "layers[0].field"}));
}

TEST(ValidateSize, RefusesNothingAndTooMuch) {
    EXPECT_TRUE(validate(PictureSize{1, 1}).has_value());
    EXPECT_TRUE(validate(PictureSize{8192, 8192}).has_value());
    EXPECT_EQ(refusalOf(validate(PictureSize{0, 5})),
              (Refusal{ErrorCode::kInvalidArgument, "size"}));
    EXPECT_EQ(refusalOf(validate(PictureSize{5, -1})),
              (Refusal{ErrorCode::kInvalidArgument, "size"}));
    EXPECT_EQ(refusalOf(validate(PictureSize{8193, 5})),
              (Refusal{ErrorCode::kLimitExceeded, "size"}));
}

}  // namespace
}  // namespace volcast::scene
