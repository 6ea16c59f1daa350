#include "renderer/worker/scene_message.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/worker/frame_message.h"

namespace volcast::worker {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

scene::Scene fullScene() {
    scene::Scene scene;
    scene.camera = {.eye = {1.5, -2.25, 3.125},
                    .center = {0.5, 0.25, -1.0},
                    .up = {0.0, 0.0, 1.0},
                    .projection = scene::Projection::kOrthographic,
                    .fovyDegrees = 45.0,
                    .orthographicHeight = 2.75};
    scene.background = {0.25F, 0.5F, 0.75F, 0.125F};
    const data::TransferFunction map{
        {{.value = -1.0F, .colour = {0.1F, 0.2F, 0.3F}, .extinction = 0.0F},
         {.value = 0.1F, .colour = {1.0F, 0.0F, 0.0F}, .extinction = 3.7F}}};
    scene.layers = {{.id = "a",
                     .dataset = "mesh",
                     .field = "pressure",
                     .timeStep = 3,
                     .model = scene::RayModel::kVolume,
                     .map = map,
                     .scale = {.kind = scene::Scale::Kind::kPower, .exponent = 0.5F},
                     .visible = false,
                     .densityField = "density",
                     .densityMap = {{{.value = 2.0F, .extinction = 1.5F}}},
                     .densityScale = {.kind = scene::Scale::Kind::kLog,
                                      .domain = data::Range{.min = 0.5F, .max = 8.0F}},
                     .interval = data::Range{.min = -0.5F, .max = 0.75F},
                     .markers = {.field = "material", .values = {1.0F, 7.0F}},
                     .coloured = true,
                     .surfaceColour = {0.5F, 0.25F, 1.0F},
                     .headlight = false,
                     .edgeWidth = 2.5F,
                     .edgeColour = {0.25F, 0.5F, 0.125F},
                     .levels = {.spacing = scene::Levels::Spacing::kPower,
                                .values = {0.25F, 0.5F},
                                .first = -1.0F,
                                .last = 3.0F,
                                .count = 5,
                                .exponent = 3.0F},
                     .extinctionScale = 0.5F,
                     .exposure = -1.5F,
                     .integrator = scene::Integrator::kPsi,
                     .evaluator = scene::MeshEvaluator::kProjection,
                     .stepWorld = 0.0,
                     .sampling = scene::Sampling::kTricubic,
                     .light = scene::Light{.position = glm::dvec3{1.5, -2.0, 1e7},
                                           .ambient = 0.125F,
                                           .diffuse = 0.5F,
                                           .specular = 0.25F,
                                           .exponent = 7.0F}},
                    {.id = "b",
                     .dataset = "volume",
                     .field = {},
                     .timeStep = 0,
                     .model = scene::RayModel::kMip,
                     .map = map,
                     .visible = true,
                     .coloured = false,
                     .surfaceColour = glm::vec3(0.8F),
                     .headlight = true,
                     .integrator = scene::Integrator::kAuto,
                     .stepWorld = 0.125,
                     .sampling = scene::Sampling::kNearest}};
    scene.clipPlanes = {{.normal = {0.0, 1.0, 0.5}, .offset = -0.25}};
    scene.accuracy = {.kind = scene::Accuracy::Kind::kTimeBudget, .bound = 33.5};
    return scene;
}

/// The field that an edited copy of a good message is refused for.
template <class Edit>
Error refusal(Edit edit) {
    v1::Scene message = toMessage(fullScene());
    edit(message);
    const auto scene = sceneFrom(message);
    EXPECT_FALSE(scene.has_value());
    return scene ? Error{} : scene.error();
}

TEST(SceneMessage, ComesBackEqual) {
    const scene::Scene scene = fullScene();
    const auto back = sceneFrom(toMessage(scene));
    ASSERT_TRUE(back.has_value()) << back.error().field << ": " << back.error().message;
    EXPECT_EQ(*back, scene);
}

TEST(SceneMessage, AbsentPartsAreDefaults) {
    const auto scene = sceneFrom(v1::Scene{});
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    EXPECT_EQ(*scene, scene::Scene{});
}

TEST(SceneMessage, CameraMayNameOnlyItsEye) {
    v1::Camera message;
    message.mutable_eye()->set_x(5.0);
    const auto camera = cameraFrom(message);
    ASSERT_TRUE(camera.has_value());
    scene::Camera expected;
    expected.eye = {5.0, 0.0, 0.0};
    EXPECT_EQ(*camera, expected);
}

TEST(SceneMessage, RefusesACameraThatIsNoNumber) {
    for (const double bad : {kNaN, HUGE_VAL, -HUGE_VAL}) {
        const Error error =
            refusal([&](v1::Scene& scene) { scene.mutable_camera()->mutable_eye()->set_y(bad); });
        EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
        EXPECT_TRUE(error.field.starts_with("camera.eye")) << error.field;
        const Error angle = refusal([&](v1::Scene& scene) {
            scene.mutable_camera()->set_projection(v1::PROJECTION_PERSPECTIVE);
            scene.mutable_camera()->set_fovy_degrees(bad);
        });
        EXPECT_EQ(angle.code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(angle.field, "camera.fovy_degrees");
    }
}

TEST(SceneMessage, NamesTheCameraByItsPath) {
    v1::Camera message;
    message.mutable_eye()->set_x(kNaN);
    const auto camera = cameraFrom(message, "update.camera");
    ASSERT_FALSE(camera.has_value());
    EXPECT_TRUE(camera.error().field.starts_with("update.camera.eye")) << camera.error().field;
}

TEST(SceneMessage, NamesTheControlPointAtFault) {
    for (const double bad : {kNaN, HUGE_VAL, 1e300}) {
        const Error error = refusal([&](v1::Scene& scene) {
            scene.mutable_layers(1)->mutable_transfer_function()->mutable_points(1)->set_value(bad);
        });
        EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(error.field, "layers[1].transfer_function.points[1].value");
    }
    const Error negative = refusal([](v1::Scene& scene) {
        scene.mutable_layers(0)->mutable_transfer_function()->mutable_points(0)->set_extinction(-1);
    });
    EXPECT_EQ(negative.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(negative.field, "layers[0].transfer_function.points[0].extinction");
}

TEST(SceneMessage, RefusesEnumeratorsItDoesNotKnow) {
    const Error model = refusal([](v1::Scene& scene) {
        scene.mutable_layers(0)->set_model(static_cast<v1::RayModel>(77));
    });
    EXPECT_EQ(model.code, ErrorCode::kUnsupported);
    EXPECT_EQ(model.field, "layers[0].model");
    const Error sampling = refusal([](v1::Scene& scene) {
        scene.mutable_layers(1)->set_sampling(static_cast<v1::Sampling>(-5));
    });
    EXPECT_EQ(sampling.field, "layers[1].sampling");
    const Error light = refusal(
        [](v1::Scene& scene) { scene.mutable_layers(1)->mutable_light()->set_diffuse(1e39); });
    EXPECT_EQ(light.field, "layers[1].light.diffuse");
    const Error integrator = refusal([](v1::Scene& scene) {
        scene.mutable_layers(1)->set_integrator(static_cast<v1::Integrator>(9));
    });
    EXPECT_EQ(integrator.field, "layers[1].integrator");
    const Error projection = refusal([](v1::Scene& scene) {
        scene.mutable_camera()->set_projection(static_cast<v1::Projection>(9));
    });
    EXPECT_EQ(projection.field, "camera.projection");
}

TEST(SceneMessage, RefusesMoreThanTheLimits) {
    const Error points = refusal([](v1::Scene& scene) {
        for (std::size_t i = 0; i <= data::TransferFunction::kMaxPoints; ++i) {
            scene.mutable_layers(0)->mutable_transfer_function()->add_points();
        }
    });
    EXPECT_EQ(points.code, ErrorCode::kLimitExceeded);
    EXPECT_EQ(points.field, "layers[0].transfer_function.points");
    const Error layers = refusal([](v1::Scene& scene) {
        while (scene.layers_size() <= static_cast<int>(scene::Scene::kMaxLayers)) {
            scene.add_layers();
        }
    });
    EXPECT_EQ(layers.code, ErrorCode::kLimitExceeded);
    EXPECT_EQ(layers.field, "layers");
}

TEST(SceneMessage, RefusesABackgroundThatIsNone) {
    for (const double bad : {-0.1, 1.1, kNaN}) {
        const Error error =
            refusal([&](v1::Scene& scene) { scene.set_background_transparency(bad); });
        EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(error.field, "background_transparency");
    }
    const Error colour = refusal([](v1::Scene& scene) {
        scene.mutable_background()->set_g(std::numeric_limits<float>::quiet_NaN());
    });
    EXPECT_TRUE(colour.field.starts_with("background")) << colour.field;
}

TEST(FrameMessage, PlanComesBackEqual) {
    const plan::FramePlan plan{
        .id = "abc",
        .layers = {{.layer = "a",
                    .evaluator = plan::Evaluator::kVolumeMarch,
                    .integrator = "march",
                    .stepWorld = 0.25,
                    .effects = {{.name = "empty bricks", .on = true, .reason = "some are"},
                                {.name = "shading", .on = false, .reason = "unlit"}},
                    .drawn = true,
                    .drawnWith = {}},
                   {.layer = "b",
                    .evaluator = plan::Evaluator::kMeshRaster,
                    .integrator = {},
                    .stepWorld = 0.0,
                    .effects = {},
                    .drawn = false,
                    .drawnWith = "a"}}};
    internal::v1::Rendered message;
    put(plan, &message);
    const plan::FramePlan back = planFrom(message);
    EXPECT_EQ(back.id, plan.id);
    ASSERT_EQ(back.layers.size(), plan.layers.size());
    for (std::size_t i = 0; i < plan.layers.size(); ++i) {
        EXPECT_EQ(back.layers[i].layer, plan.layers[i].layer);
        EXPECT_EQ(back.layers[i].evaluator, plan.layers[i].evaluator);
        EXPECT_EQ(back.layers[i].integrator, plan.layers[i].integrator);
        EXPECT_EQ(back.layers[i].stepWorld, plan.layers[i].stepWorld);
        EXPECT_EQ(back.layers[i].drawn, plan.layers[i].drawn);
        EXPECT_EQ(back.layers[i].drawnWith, plan.layers[i].drawnWith);
        ASSERT_EQ(back.layers[i].effects.size(), plan.layers[i].effects.size());
    }
    EXPECT_TRUE(back.layers[0].has("empty bricks"));
    EXPECT_FALSE(back.layers[0].has("shading"));
    EXPECT_EQ(back.layers[0].effects[1].reason, "unlit");
}

TEST(FrameMessage, ErrorComesBackEqualAndAnUnknownCodeIsTamed) {
    const Error error = fail(ErrorCode::kShaderBuild, "model/mip.glsl:17: no", "layers[0].model");
    const Error back = errorFrom(toMessage(error));
    EXPECT_EQ(back.code, error.code);
    EXPECT_EQ(back.message, error.message);
    EXPECT_EQ(back.field, error.field);
    internal::v1::Failed strange;
    strange.set_code(1000);
    EXPECT_EQ(errorFrom(strange).code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace volcast::worker
