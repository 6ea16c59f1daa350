#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/reference/scenes.h"

/// Fields, scales, second fields, layers, cameras, edges, and what is refused.
namespace volcast::reference::test {
namespace {

using scene::RayModel;

constexpr double kRounding = 1e-13;
constexpr double kFloat = 1e-7;  // One rounding to float32 of numbers up to 1.
const glm::dvec3 kEye{0.37, 0.41, -2.0};
const glm::dvec3 kCenter{0.37, 0.41, 0.5};

/// The unit cube with f = z and g = 1 - z.
data::Mesh opposed() {
    data::MeshInput input = support::latticeMesh({.cubes = {1, 1, 2}});
    support::addField(input, "f", data::Association::kVertex, [](const auto& p) { return p.z; });
    support::addField(input, "g", data::Association::kVertex,
                      [](const auto& p) { return 1.0 - p.z; });
    support::addField(input, "cells", data::Association::kCell,
                      [](const auto& p) { return p.z < 0.5 ? 0.25 : 0.75; });
    return built(std::move(input));
}

TEST(Fields, OnCellsAreConstantInEach) {
    const data::Mesh mesh = opposed();
    scene::Layer layer = layerOf(RayModel::kVolume, ramp(2.0F));
    layer.field = "cells";
    const glm::dvec4 found = seen(mesh, layer, kEye, kCenter);
    // Halves of extinction 1/2 and 3/2, colours 1/4 and 3/4.
    const double near = -std::expm1(-0.25), far = -std::expm1(-0.75);
    EXPECT_NEAR(found.r, 0.25 * near + (1.0 - near) * 0.75 * far, kRounding);
    EXPECT_NEAR(found.a, -std::expm1(-1.0), kRounding);
    layer.model = RayModel::kMip;
    EXPECT_EQ(seen(mesh, layer, kEye, kCenter).r, 0.75);
}

TEST(SecondField, GivesTheExtinction) {
    const data::Mesh mesh = opposed();
    scene::Layer layer = layerOf(RayModel::kVolume, ramp(2.0F));
    layer.densityField = "g";
    // C = z, rho = 2 (1 - z): with u = 1 - z, int (1 - u) 2 u exp(u^2 - 1) du over [0, 1]
    // = 1 - 1/e - (1 - D(1)) = D(1) - 1/e, D being Dawson's integral.
    constexpr double kDawson = 0.53807950691276841914;
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, kDawson - std::exp(-1.0), kRounding);
    layer.densityMap = constant({0, 0, 0}, 3.0F);
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).a, -std::expm1(-3.0), kRounding);
    layer.model = RayModel::kXray;
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, std::exp(-3.0), kRounding);
    layer.model = RayModel::kIsosurface;
    layer.levels.values = {0.25F};
    layer.densityMap = {};
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, 0.75, kRounding);
    layer.densityMap = constant({0.125F, 0, 0}, 0.0F);
    EXPECT_EQ(seen(mesh, layer, kEye, kCenter).r, 0.125);
}

TEST(SecondField, WithoutOneTheDensityMapReadsTheFirst) {
    scene::Layer layer = layerOf(RayModel::kXray, ramp(2.0F));
    layer.densityMap = ramp(5.0F);
    EXPECT_NEAR(seen(opposed(), layer, kEye, kCenter).r, std::exp(-2.5), kRounding);
}

TEST(Scales, AreAppliedToVerticesBeforeRaysInterpolate) {
    // One cube along z with f = 1 below and 100 above: log f is linear in z, f is not.
    const data::Mesh mesh =
        boxOf({.cubes = glm::ivec3{1}}, [](const auto& p) { return p.z < 0.5 ? 1.0 : 100.0; });
    scene::Layer layer = layerOf(RayModel::kSplat, {});
    layer.scale.kind = scene::Scale::Kind::kLog;
    layer.map.points = {{.value = 1.0F, .colour = glm::vec3{0.0F}},
                        {.value = 10.0F, .colour = glm::vec3{1.0F}},
                        {.value = 100.0F, .colour = glm::vec3{0.0F}}};
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, 0.5, kFloat);
    layer.model = RayModel::kIsosurface;
    layer.levels.values = {10.0F};
    auto scene = sceneOf(along(kEye, kCenter), {layer});
    scene.clipPlanes = {{.normal = {0, 0, 1}, .offset = 0.499}};
    EXPECT_NEAR(drawn(scene, mesh).pixels[0].r, 1.0, kFloat);
    scene.clipPlanes[0].offset = 0.501;
    EXPECT_EQ(drawn(scene, mesh).pixels[0].a, 0.0);
    // ((f - 1) / 99)^2 is linear in z from 0 to 1, so f = 1 + 99 / 2 lies at z = 1/4.
    layer.scale = {.kind = scene::Scale::Kind::kPower, .exponent = 2.0F};
    layer.levels.values = {50.5F};
    scene = sceneOf(along(kEye, kCenter), {layer});
    scene.clipPlanes = {{.normal = {0, 0, 1}, .offset = 0.249}};
    EXPECT_EQ(drawn(scene, mesh).pixels[0].a, 1.0);
    scene.clipPlanes[0].offset = 0.251;
    EXPECT_EQ(drawn(scene, mesh).pixels[0].a, 0.0);
}

TEST(Layers, OpaqueOnesEndTheRaysOfOthers) {
    const data::Mesh mesh = opposed();
    scene::Layer level = layerOf(RayModel::kIsosurface, constant({0, 0, 1}, 0.0F));
    level.levels.values = {0.25F};
    scene::Layer behind = level;
    behind.levels.values = {0.75F};
    behind.map = constant({0, 1, 0}, 0.0F);
    const scene::Layer fog = layerOf(RayModel::kVolume, constant({1, 0, 0}, 2.0F));
    const auto colour = [&](std::vector<scene::Layer> layers) {
        return drawn(sceneOf(along(kEye, kCenter), std::move(layers)), mesh).pixels[0];
    };
    const double alpha = -std::expm1(-0.5);
    for (const auto& layers : {std::vector{fog, level, behind}, std::vector{behind, level, fog}}) {
        const glm::dvec4 found = colour(layers);
        EXPECT_NEAR(found.r, alpha, kRounding);
        EXPECT_EQ(found.g, 0.0);
        EXPECT_NEAR(found.b, 1.0 - alpha, kRounding);
        EXPECT_NEAR(found.a, 1.0, kRounding);
    }
    // Others lie over those before them; an x-ray covers all, a splat adds.
    scene::Layer splat = layerOf(RayModel::kSplat, constant({0, 0.5F, 0}, 0.0F));
    const glm::dvec4 added = colour({fog, splat});
    EXPECT_NEAR(added.r, -std::expm1(-2.0), kRounding);
    EXPECT_NEAR(added.g, 0.5, kRounding);
    EXPECT_NEAR(added.a, -std::expm1(-2.0), kRounding);
    scene::Layer xray = layerOf(RayModel::kXray, constant({0, 0, 0}, 3.0F));
    EXPECT_NEAR(colour({fog, xray}).g, std::exp(-3.0), kRounding);
    EXPECT_NEAR(colour({xray, fog}).g, std::exp(-2.0) * std::exp(-3.0), kRounding);
    level.visible = false;
    EXPECT_NEAR(colour({level, behind, fog}).g, std::exp(-1.5), kRounding);
}

TEST(Wireframe, EdgesFadeOverOnePixel) {
    // A tetrahedron that faces the eye with an edge along y at x = 0.
    data::MeshInput input;
    input.points = {{0, -4, 0}, {0, 4, 0}, {4, 0, 0}, {1, 0, 4}};
    input.cells = {{0, 1, 2, 3}};
    support::addField(input, "f", data::Association::kVertex, [](const auto&) { return 0.0; });
    const data::Mesh mesh = built(std::move(input));
    scene::Layer layer = layerOf(RayModel::kWireframe, ramp());
    layer.surfaceColour = glm::vec3{0.0F};
    layer.edgeColour = glm::vec3{1.0F};
    layer.edgeWidth = 3.0F;
    scene::Camera camera = along({0, 0, -10}, {0, 0, 0});
    camera.orthographicHeight = 1.0;
    constexpr int kPixels = 16;
    // x grows to the left here: right is forward x up. Pixel k left of the middle is k + 1/2 away.
    const auto at = [&](const scene::Camera& from, int k) {
        return drawn(sceneOf(from, {layer}), mesh, {kPixels, kPixels}, {{7 - k, 8}}).pixels[0].r;
    };
    EXPECT_EQ(at(camera, 0), 1.0);
    EXPECT_EQ(at(camera, 1), 0.5);
    EXPECT_EQ(at(camera, 2), 0.0);
    // The same size of a pixel at distance 10 in perspective.
    camera.projection = scene::Projection::kPerspective;
    camera.fovyDegrees = 2.0 * std::atan(0.05) * 180.0 / M_PI;
    EXPECT_NEAR(at(camera, 1), 0.5, 1e-12);
    EXPECT_NEAR(at(camera, 2), 0.0, 1e-12);
}

TEST(NearEdge, IsTheRimOfWhatIsSeen) {
    // A cube of 1/2 of the picture's height: sides 16 pixels from the middle of 64.
    const data::Mesh mesh =
        boxOf({.cubes = glm::ivec3{4}}, [](const auto& p) { return glm::length(p - 0.5); });
    scene::Camera camera = along({0.5, 0.5, -3.0}, {0.5, 0.5, 0.5});
    camera.orthographicHeight = 2.0;
    const auto flagged = [&](const scene::Layer& layer) {
        const Picture picture = drawn(sceneOf(camera, {layer}), mesh, {64, 64});
        return std::pair{std::count(picture.nearEdge.begin(), picture.nearEdge.end(), 1),
                         picture.nearEdge[32 * 64 + 16]};
    };
    // Two rows of pixels along each side: the last within, the first beyond.
    const auto [surface, atSide] = flagged(layerOf(RayModel::kSurface, ramp()));
    EXPECT_EQ(surface, 34 * 34 - 30 * 30);
    EXPECT_EQ(atSide, 1);
    EXPECT_EQ(flagged(layerOf(RayModel::kVolume, ramp())).first, 34 * 34 - 30 * 30);
    // A ball of radius about 0.4, 12.8 pixels, as level: a ring two pixels wide. Two levels: as
    // much again, although the inner one is hidden.
    scene::Layer ball = layerOf(RayModel::kIsosurface, ramp());
    ball.levels.values = {0.4F};
    const auto one = flagged(ball).first;
    EXPECT_GT(one, 100);
    EXPECT_LT(one, 240);
    ball.levels.values = {0.3F, 0.4F};
    EXPECT_EQ(flagged(ball).first, one);
}

TEST(NearEdge, IsNotTheRimOfWhatIsHidden) {
    // A plate, and behind it a cube that it hides: as many pixels as for the plate alone.
    const auto flagged = [](bool cube) {
        const data::Mesh mesh =
            boxOf({.cubes = glm::ivec3{5},
                   .keep =
                       [&](const auto& c) {
                           return c.z == 0 || (cube && c == glm::ivec3{2, 2, 4});
                       }},
                  [](const auto& p) { return p.z; });
        scene::Camera camera = along({0.9, 0.8, -3.0}, {0.5, 0.5, 0.5});
        camera.orthographicHeight = 2.0;
        const auto scene = sceneOf(camera, {layerOf(RayModel::kSurface, ramp())});
        const Picture picture = drawn(scene, mesh, {64, 64});
        return std::count(picture.nearEdge.begin(), picture.nearEdge.end(), 1);
    };
    EXPECT_GT(flagged(false), 34 * 34 - 30 * 30);  // Seen at an angle: the plate's sides show.
    EXPECT_EQ(flagged(true), flagged(false));
}

TEST(Refusals, NameWhatIsWrong) {
    const data::Mesh mesh = opposed();
    const std::map<std::string, const data::Mesh*> meshes{{"mesh", &mesh}};
    const auto codeOf = [&](const scene::Scene& scene, const std::string& field) {
        const auto picture = draw(scene, meshes, {1, 1});
        EXPECT_FALSE(picture.has_value());
        if (picture.has_value()) return ErrorCode::kIo;
        EXPECT_EQ(picture.error().field, field) << picture.error().message;
        return picture.error().code;
    };
    auto scene = sceneOf(along(kEye, kCenter), {layerOf(RayModel::kVolume, ramp())});
    scene.layers[0].dataset = "voxels";
    EXPECT_EQ(codeOf(scene, "layers[0].dataset"), ErrorCode::kNotFound);
    scene.layers[0].dataset = "mesh";
    scene.layers[0].field = "h";
    EXPECT_EQ(codeOf(scene, "layers[0].field"), ErrorCode::kNotFound);
    scene.layers[0].field = "f";
    scene.layers[0].densityField = "h";
    EXPECT_EQ(codeOf(scene, "layers[0].density_field"), ErrorCode::kNotFound);
    scene.layers[0].densityField.clear();
    scene.layers[0].timeStep = 1;
    EXPECT_EQ(codeOf(scene, "layers[0].time_step"), ErrorCode::kInvalidArgument);
    scene.layers[0].timeStep = 0;
    scene.layers[0].markers = {.field = "g", .values = {0.0F}};
    EXPECT_EQ(codeOf(scene, "layers[0].markers.field"), ErrorCode::kUnsupported);
    scene.layers[0].markers = {};
    scene.layers[0].scale.kind = scene::Scale::Kind::kLog;  // Over [0, 1].
    EXPECT_EQ(codeOf(scene, "layers[0].scale.domain"), ErrorCode::kInvalidArgument);
    scene.layers[0].scale = {};
    const std::vector<glm::ivec2> outside{{1, 0}};
    EXPECT_EQ(draw(scene, meshes, {1, 1}, outside).error().code, ErrorCode::kInvalidArgument);
    const std::atomic<bool> cancelled{true};
    EXPECT_EQ(draw(scene, meshes, {1, 1}, {}, 1, &cancelled).error().code, ErrorCode::kTimeout);
}

}  // namespace
}  // namespace volcast::reference::test
