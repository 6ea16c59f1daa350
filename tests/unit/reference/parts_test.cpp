#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/reference/scenes.h"

/// Which part of the data rays see: intervals, markers, missing values, clip planes, the eye,
/// holes.
namespace volcast::reference::test {
namespace {

using scene::RayModel;

constexpr double kRounding = 1e-13;
const glm::dvec3 kEye{0.37, 0.41, -2.0};
const glm::dvec3 kCenter{0.37, 0.41, 0.5};

scene::Layer fog() {
    return layerOf(RayModel::kVolume, constant(glm::vec3{1.0F}, 1.0F));
}

double lengthSeen(const data::Mesh& mesh, const scene::Layer& layer, const glm::dvec3& eye = kEye,
                  const glm::dvec3& center = kCenter) {
    return lengthOf(seen(mesh, layer, eye, center).a);
}

/// f = z, "third" = index of the third along z that a cell lies in, in the box [0, 1]^3.
data::Mesh thirds() {
    data::MeshInput input = support::latticeMesh({.cubes = {2, 2, 4}});
    support::addField(input, "f", data::Association::kVertex, [](const auto& p) { return p.z; });
    support::addField(input, "quarter", data::Association::kCell,
                      [](const auto& p) { return std::floor(4.0 * p.z); });
    return built(std::move(input));
}

/// `mesh` with value `index` of its field replaced.
data::Mesh with(data::Mesh mesh, std::size_t field, std::size_t index, float value) {
    base::Array<float>& step = mesh.fields[field].steps[0];
    std::vector<float> values{step.begin(), step.end()};
    values[index] = value;
    step = std::move(values);
    return mesh;
}

TEST(Interval, CutsEveryModel) {
    const data::Mesh mesh = thirds();
    const data::Range interval{.min = 0.3125F, .max = 0.875F};
    scene::Layer layer = fog();
    layer.interval = interval;
    EXPECT_NEAR(lengthSeen(mesh, layer), 0.5625, kRounding);
    const auto value = [&](RayModel model) {
        scene::Layer own = layerOf(model, ramp());
        own.interval = interval;
        own.levels.values = {0.25F, 0.5F, 0.9F};
        own.coloured = true;
        return seen(mesh, own, kEye, kCenter);
    };
    EXPECT_EQ(value(RayModel::kMip).r, 0.875);
    EXPECT_EQ(value(RayModel::kMinip).r, 0.3125);
    EXPECT_EQ(value(RayModel::kMipColour).r, 0.875);
    EXPECT_NEAR(value(RayModel::kSplat).r, 0.5 * (0.875 * 0.875 - 0.3125 * 0.3125), kRounding);
    EXPECT_NEAR(value(RayModel::kIsosurface).r, 0.5, kRounding);
    EXPECT_EQ(value(RayModel::kSurface), glm::dvec4{0.0});  // f is 0 and 1 at both of its points.
}

TEST(Interval, KeepsCellsOfConstantValueAtItsEnd) {
    scene::Layer layer = fog();
    layer.field = "quarter";
    layer.interval = data::Range{.min = 1.0F, .max = 2.0F};
    EXPECT_NEAR(lengthSeen(thirds(), layer), 0.5, kRounding);
}

TEST(Markers, MakeABoundaryOfTheirOwn) {
    const data::Mesh mesh = thirds();
    scene::Layer layer = fog();
    layer.markers = {.field = "quarter", .values = {1.0F, 3.0F}};
    EXPECT_NEAR(lengthSeen(mesh, layer), 0.5, kRounding);
    layer = layerOf(RayModel::kSurface, ramp());
    layer.markers = {.field = "quarter", .values = {1.0F, 3.0F}};
    layer.coloured = true;
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, 0.25, kRounding);
    EXPECT_EQ(seen(mesh, layer, {0.37, 0.41, 2.0}, kCenter).r, 1.0);
    EXPECT_NEAR(seen(mesh, layer, {0.37, 0.41, 0.625}, kCenter).r, 0.5, kRounding);
    layer.model = RayModel::kMip;
    layer.markers.values = {0.0F, 1.0F};
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, 0.5, kRounding);
}

TEST(MissingValues, LeaveOutTheirCells) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const data::Mesh mesh = thirds();
    const auto cells = mesh.fields[1].steps[0];
    // All cells of the second quarter.
    data::Mesh holed = mesh;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] == 1.0F) holed = with(holed, 1, i, nan);
    }
    scene::Layer layer = fog();
    layer.field = "quarter";
    EXPECT_NEAR(lengthSeen(holed, layer), 0.75, kRounding);
    layer.field = "f";
    EXPECT_NEAR(lengthSeen(holed, layer), 1.0, kRounding);  // Does not read that field.
    layer.densityField = "quarter";
    EXPECT_NEAR(lengthSeen(holed, layer), 0.75, kRounding);
    // A vertex without a value takes all cells around it.
    const data::Mesh pointless = with(mesh, 0, 0, nan);
    layer.densityField.clear();
    const glm::dvec3 point = mesh.origin + glm::dvec3{mesh.vertices[0]};
    const glm::dvec3 inside = 0.99 * point + 0.01 * mesh.origin;
    EXPECT_LT(lengthSeen(pointless, layer, inside - glm::dvec3{0, 0, 2}, inside), 0.8);
    EXPECT_NEAR(lengthSeen(mesh, layer, inside - glm::dvec3{0, 0, 2}, inside), 1.0, kRounding);
}

TEST(ClipPlanes, KeepOneSide) {
    const data::Mesh mesh = thirds();
    auto scene = sceneOf(along(kEye, kCenter), {fog()});
    scene.clipPlanes = {{.normal = {0, 0, 2}, .offset = 0.25},
                        {.normal = {0, 0, -1}, .offset = -0.9}};
    EXPECT_NEAR(lengthOf(drawn(scene, mesh).pixels[0].a), 0.775, kRounding);
    scene.layers[0] = layerOf(RayModel::kSurface, ramp());
    scene.layers[0].coloured = true;
    EXPECT_EQ(drawn(scene, mesh).pixels[0], glm::dvec4{0.0});  // Both points are cut away.
    scene.clipPlanes.pop_back();
    EXPECT_EQ(drawn(scene, mesh).pixels[0].r, 1.0);  // The inside of the far side.
    scene.clipPlanes = {{.normal = {1, 0, 0}, .offset = 0.5}};
    EXPECT_EQ(drawn(scene, mesh).pixels[0], glm::dvec4{0.0});
}

TEST(TheEye, MayBeInTheMesh) {
    const data::Mesh mesh = thirds();
    for (const double z : {0.0, 0.25, 0.6}) {  // On a face of the box, in the lattice, in a cell.
        EXPECT_NEAR(lengthSeen(mesh, fog(), {0.37, 0.41, z}, {0.37, 0.41, 2.0}), 1.0 - z,
                    kRounding);
    }
    scene::Layer mip = layerOf(RayModel::kMip, ramp());
    EXPECT_NEAR(seen(mesh, mip, {0.37, 0.41, 0.6}, {0.37, 0.41, -1.0}).r, 0.6, kRounding);
    scene::Layer level = layerOf(RayModel::kIsosurface, ramp());
    level.levels.values = {0.5F, 0.625F};
    EXPECT_NEAR(seen(mesh, level, {0.37, 0.41, 0.6}, {0.37, 0.41, 2.0}).r, 0.625, kRounding);
    EXPECT_NEAR(seen(mesh, level, {0.37, 0.41, 0.6}, {0.37, 0.41, -2.0}).r, 0.5, kRounding);
    // On a vertex of the lattice, along its edges and diagonals.
    for (const glm::dvec3& way : {glm::dvec3{0, 0, 1}, glm::dvec3{1, 1, 0}, glm::dvec3{1, 1, 1}}) {
        const glm::dvec3 eye{0.5};
        EXPECT_NEAR(lengthSeen(mesh, fog(), eye, eye + way), 0.5 * glm::length(way), kRounding);
    }
}

TEST(Holes, AreLeftAndEnteredAgain) {
    const data::Mesh mesh = boxOf({.cubes = {8, 1, 1},
                                   .low = glm::dvec3{0.0},
                                   .high = {8, 1, 1},
                                   .keep = [](const auto& c) { return c.x % 2 == 0; }},
                                  [](const auto& p) { return p.x / 8.0; });
    const glm::dvec3 eye{-1.0, 0.3, 0.4}, center{4.0, 0.3, 0.4};
    EXPECT_NEAR(lengthSeen(mesh, fog(), eye, center), 4.0, kRounding);
    // Four slabs of depth 1, in one colour each: every one is dimmed by those before it.
    double expected = 0.0;
    for (int slab = 0; slab < 4; ++slab) {
        expected += slab % 2 * std::exp(-slab) * -std::expm1(-1.0);
    }
    scene::Layer stripes = layerOf(RayModel::kVolume, {});
    for (const float x : {1.5F, 3.5F, 5.5F}) {  // Colours change in the holes.
        const bool on = x == 1.5F || x == 5.5F;
        stripes.map.points.push_back(
            {.value = x / 8.0F, .colour = glm::vec3{on ? 0.0F : 1.0F}, .extinction = 1.0F});
        stripes.map.points.push_back(
            {.value = x / 8.0F, .colour = glm::vec3{on ? 1.0F : 0.0F}, .extinction = 1.0F});
    }
    EXPECT_NEAR(seen(mesh, stripes, eye, center).r, expected, kRounding);
    EXPECT_NEAR(seen(mesh, layerOf(RayModel::kMip, ramp()), eye, center).r, 7.0 / 8.0, kRounding);
    scene::Layer level = layerOf(RayModel::kIsosurface, ramp());
    level.levels.values = {0.2F, 0.3F};  // x = 1.6 lies in a hole, x = 2.4 does not.
    EXPECT_NEAR(seen(mesh, level, eye, center).r, 0.3F, kRounding);
}

}  // namespace
}  // namespace volcast::reference::test
