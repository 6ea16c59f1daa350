// Code on meshes: the picture of a map, closed forms, fields by their number, the cost of a change.
#include <cmath>

#include <gmock/gmock.h>

#include "renderer/plan/effects.h"
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using data::Association;
using scene::RayModel;
using ::testing::HasSubstr;

class UserShaderMesh : public support::MeshTest {
protected:
    /// The box of latticeMesh() with fields at vertices, cells and corners that are known: x, the
    /// y of the cell's centre, and z.
    static data::MeshInput box(const glm::ivec3& cubes = {4, 4, 4}) {
        data::MeshInput mesh = support::latticeMesh(
            {.cubes = cubes,
             .low = glm::dvec3{0.0},
             .high = glm::dvec3{1.0},
             .keep = {},
             .move = support::jitter(cubes, glm::dvec3{0.0}, glm::dvec3{1.0}, 0.3)});
        support::addField(mesh, "x", Association::kVertex, [](const auto& p) { return p.x; });
        support::addField(mesh, "y", Association::kCell, [](const auto& p) { return p.y; });
        support::addField(mesh, "z", Association::kCellVertex, [](const auto& p) { return p.z; });
        return mesh;
    }
    static constexpr double kDiagonal = 1.7320508075688772;
    /// Opacities are those of this length.
    static constexpr double kReference = kDiagonal / 64.0;

    static scene::Camera fromCorner() {
        return support::perspective({3.0, 2.1, 2.6}, {0.5, 0.5, 0.5}, 25.0);
    }
    /// Through the box along z, at (x, y) in the middle of the picture.
    static scene::Camera alongZ(double x, double y) {
        return support::orthographic({x, y, 5.0}, {x, y, 0.0}, 1e-3);
    }

    scene::Scene byCode(const scene::Camera& camera, const std::string& code,
                        RayModel model = RayModel::kVolume, const std::string& field = "x") {
        scene::Scene scene = sceneOf(camera, model, {}, field);
        scene.layers[0].shader.code = code;
        return scene;
    }

    static double largestDifference(const support::Drawn& a, const support::Drawn& b) {
        double largest = 0.0;
        for (std::size_t i = 0; i < a.linear.size(); ++i) {
            largest = std::max(largest, std::abs(double{a.linear[i]} - b.linear[i]));
        }
        return largest;
    }

    static double drawnShare(const support::Drawn& picture) {
        std::size_t drawn = 0;
        for (std::size_t i = 3; i < picture.linear.size(); i += 4) {
            if (picture.linear[i] > 0.01F) ++drawn;
        }
        return 4.0 * static_cast<double>(drawn) / static_cast<double>(picture.linear.size());
    }
};

/// Extinction 6 v of the layer's value v, in a colour that does not change.
std::string fogCode(double reference) {
    return "void main() { float v = getInterpolatedDataValue();\n"
           "emitRGBA(vec4(1.0, 0.5, 0.1, 1.0 - exp(-6.0 * v * " +
           std::to_string(reference) + "))); }";
}

data::TransferFunction fogMap() {
    return {{{.value = 0.0F, .colour = {1.0F, 0.5F, 0.1F}, .extinction = 0.0F},
             {.value = 1.0F, .colour = {1.0F, 0.5F, 0.1F}, .extinction = 6.0F}}};
}

// Extinction is linear in the value, and that along a piece: a sample in its middle has the exact
// optical depth, whatever the step, and one colour needs no more. What is left is rounding, of some
// 20 pieces and as many parts: 1e-5 allows for 100 roundings of an opacity.
TEST_F(UserShaderMesh, FogOfOneColourIsThatOfItsMapAtAnyStep) {
    use(box());
    for (const char* field : {"x", "y", "z"}) {
        const auto byMap =
            draw(sceneOf(fromCorner(), RayModel::kVolume, fogMap(), field), {64, 48}, 1);
        EXPECT_GT(drawnShare(byMap), 0.2);
        scene::Scene scene = byCode(fromCorner(), fogCode(kReference), RayModel::kVolume, field);
        for (const double step : {0.0, 10.0, 0.05, 0.003}) {
            scene.layers[0].stepWorld = step;
            EXPECT_LT(largestDifference(byMap, draw(scene, {64, 48}, 2)), 1e-5)
                << field << " step " << step;
        }
    }
}

// One sample a cell with a map that changes its colour: what the integrator `average` does.
TEST_F(UserShaderMesh, OneSampleACellIsTheAverageOfItsMap) {
    use(box());
    data::TransferFunction map = fogMap();
    map.points[0].colour = {0.0F, 0.0F, 0.0F};
    scene::Scene scene = sceneOf(fromCorner(), RayModel::kVolume, map, "x");
    scene.layers[0].integrator = scene::Integrator::kAverage;
    const auto byMap = draw(scene, {64, 48}, 1);
    scene.layers[0].integrator = scene::Integrator::kAuto;
    scene.layers[0].stepWorld = 10.0;
    scene.layers[0].shader.code =
        "void main() { float v = getDataValue();\n"
        "emitRGBA(vec4(v * vec3(1.0, 0.5, 0.1), 1.0 - exp(-6.0 * v * " +
        std::to_string(kReference) + "))); }";
    EXPECT_LT(largestDifference(byMap, draw(scene, {64, 48}, 2)), 1e-5);
}

TEST_F(UserShaderMesh, AUniformSlabHasItsClosedForm) {
    use(box());
    scene::Scene scene =
        byCode(alongZ(0.37, 0.52), "void main() { emitRGBA(vec4(0.9, 0.5, 0.1, 0.03)); }");
    const double alpha = 1.0 - std::pow(1.0 - 0.03, 1.0 / kReference);
    for (const double step : {0.0, 0.31, 0.01}) {
        scene.layers[0].stepWorld = step;
        const auto picture = draw(scene, {4, 4});
        EXPECT_NEAR(picture.at(2, 1).a, alpha, 1e-5) << "step " << step;
        EXPECT_NEAR(picture.at(2, 1).r, 0.9 * alpha, 1e-5) << "step " << step;
    }
    scene.layers[0].gain = 0.5F;
    EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).a, 1.0 - std::pow(1.0 - alpha, std::exp(0.5)), 1e-5);
    scene.clipPlanes = {{.normal = {0, 0, 1}, .offset = 0.75}};
    scene.layers[0].gain = 0.0F;
    EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).a, 1.0 - std::pow(1.0 - alpha, 0.25), 1e-5);
}

// Of one dataset, or the reference distance would be another one. Both halves are drawn over each
// other, the nearer one first; z of the cells is told by a field of marks.
TEST_F(UserShaderMesh, TwoHalvesAreOne) {
    data::MeshInput mesh = box();
    support::addField(mesh, "half", Association::kCell,
                      [](const auto& p) { return p.z > 0.5 ? 1.0 : 0.0; });
    use(std::move(mesh));
    scene::Scene scene =
        byCode(support::orthographic({0.5, 0.5, 5.0}, {0.5, 0.5, 0.0}, 1.2), fogCode(kReference));
    const auto whole = draw(scene, {48, 48}, 1);
    EXPECT_GT(drawnShare(whole), 0.5);
    scene.layers.push_back(scene.layers[0]);
    scene.layers[1].id = "far";
    scene.layers[0].markers = {.field = "half", .values = {1.0F}};
    scene.layers[1].markers = {.field = "half", .values = {0.0F}};
    std::swap(scene.layers[0], scene.layers[1]);  // Later layers are over earlier ones.
    const auto halves = draw(scene, {48, 48}, 2);
    EXPECT_LT(largestDifference(whole, halves), 1e-5);
}

// x and z are linear in the cells, so that values of fields at vertices and at corners are exact.
TEST_F(UserShaderMesh, FieldsAreReadByTheirNumber) {
    use(box());
    const auto at = [&](const std::string& expression, const std::string& field) {
        scene::Scene scene = byCode(alongZ(0.37, 0.52),
                                    "#uicontrol invlerp n(range=[0, 0.5], channel=2)\n"
                                    "void main() { float z = getDataValue(2);\n"
                                    "emitIntensity(1.0 - abs(z - 0.3)); emitRGB(vec3(" +
                                        expression + ")); }",
                                    RayModel::kMip, field);
        scene.layers[0].stepWorld = 1e-3;
        return draw(scene, {4, 4}).at(2, 1).r;
    };
    // The sample is nearest to z = 0.3, by at most half a step.
    for (const char* field : {"x", "y", "z"}) {
        EXPECT_NEAR(at("getDataValue(2)", field), 0.3, 6e-4) << field;
        EXPECT_NEAR(at("getInterpolatedDataValue(0)", field), 0.37, 5e-4) << field;
        EXPECT_NEAR(at("getDataValue(1)", field), 0.52, 0.26) << field << ": of the cell's centre";
    }
    EXPECT_NEAR(at("0.5 * getDataValue()", "z"), 0.15, 3e-4);
    EXPECT_NEAR(at("n()", "x"), 0.6, 2e-3) << "n reads field 2";
}

TEST_F(UserShaderMesh, ExtremesOfSamplesApproachThoseOfTheField) {
    use(box());
    const std::string code = "void main() { emitRGB(vec3(getInterpolatedDataValue())); }";
    for (const RayModel model : {RayModel::kMip, RayModel::kMinip}) {
        const auto byMap =
            draw(sceneOf(fromCorner(), model, support::ruler(0.0F, 1.0F), "x"), {48, 48}, 1);
        scene::Scene scene = byCode(fromCorner(), code, model);
        scene.layers[0].stepWorld = 2e-3;
        // The extreme of a piece is at its end, half a step from a sample at most; |grad x| = 1.
        EXPECT_LT(largestDifference(byMap, draw(scene, {48, 48}, 2)), 1.1e-3);
    }
}

TEST_F(UserShaderMesh, ControlsAreOneUploadAndNoProgram) {
    use(box());
    scene::Scene scene =
        byCode(fromCorner(),
               "#uicontrol float s slider(min=0, max=1, default=0.5)\n#uicontrol bool b checkbox\n"
               "void main() { emitRGBA(vec4(vec3(s), b ? 0.5 : 0.02)); }");
    const auto before = draw(scene, {32, 32});
    EXPECT_GT(drawnShare(before), 0.2);
    scene.layers[0].shader.controls = {{.name = "s", .value = 0.75}};
    const auto after = draw(scene, {32, 32});
    EXPECT_GT(largestDifference(before, after), 1e-3);
    EXPECT_EQ(after.info.work.programsBuilt, 0U);
    EXPECT_EQ(after.info.work.bufferUploads, 1U);
    scene.layers[0].shader.controls = {{.name = "b", .value = true}};
    EXPECT_EQ(draw(scene, {32, 32}).info.work.programsBuilt, 1U) << "a constant of the program";
}

TEST_F(UserShaderMesh, IntervalsCutPieces) {
    use(box());
    scene::Scene scene =
        byCode(alongZ(0.37, 0.52), "void main() { emitRGBA(vec4(1.0, 1.0, 1.0, 0.03)); }",
               RayModel::kVolume, "z");
    scene.layers[0].interval = data::Range{.min = 0.2F, .max = 0.45F};
    const double alpha = 1.0 - std::pow(1.0 - 0.03, 0.25 / kReference);
    EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).a, alpha, 1e-5);
}

// Values far from 0 are kept relative to their range on the GPU; code is given them as they are.
TEST_F(UserShaderMesh, ValuesAreThoseOfTheData) {
    data::MeshInput mesh = box();
    for (const char* name : {"far", "other"}) {
        support::addField(mesh, name, Association::kVertex,
                          [](const auto& p) { return 4096.0 + p.x; });
    }
    use(std::move(mesh));
    for (const char* expression : {"getDataValue()", "getDataValue(4)"}) {
        const scene::Scene scene =
            byCode(alongZ(0.37, 0.52),
                   "void main() { emitRGB(vec3(" + std::string{expression} + " - 4096.0)); }",
                   RayModel::kMip, "far");
        // A float32 near 4096 is one of multiples of 2^-11 or 2^-12.
        EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).r, 0.37, 6e-4) << expression;
    }
}

// Meshes that rays leave and enter again, long loops, and rays that go on in further draws.
TEST_F(UserShaderMesh, LongLoopsLeaveNoRayUnfinished) {
    const glm::ivec3 cubes{4, 4, 12};
    data::MeshInput mesh = support::latticeMesh(
        {.cubes = cubes, .keep = [](const glm::ivec3& at) { return at.z % 3 != 1; }});
    support::addField(mesh, "x", Association::kVertex, [](const auto& p) { return p.x; });
    support::addField(mesh, "two", Association::kVertex, [](const auto&) { return 2.0; });
    ASSERT_FALSE(use(std::move(mesh)).convex);
    const std::string code =
        "void main() { float sum = 0.0; for (int i = 0; i < 200; ++i) sum += float(i) * "
        "getDataValue(1);\nemitRGBA(vec4(sum / 39800.0, 0.0, 0.0, 0.01)); }";
    scene::Scene scene = byCode(alongZ(0.37, 0.52), code);
    scene.layers[0].stepWorld = 1e-3;
    const double alpha = 1.0 - std::pow(1.0 - 0.01, (8.0 / 12.0) / kReference);
    const auto pixel = draw(scene, {4, 4}).at(2, 1);
    EXPECT_NEAR(pixel.a, alpha, 1e-4);
    EXPECT_NEAR(pixel.r, alpha, 1e-4) << "the other field after a ray has gone on";
}

TEST_F(UserShaderMesh, ThePlanSaysWhy) {
    use(box());
    scene::Scene scene = byCode(fromCorner(), fogCode(kReference));
    scene.layers[0].evaluator = scene::MeshEvaluator::kProjection;
    scene.layers[0].stepWorld = 1e-9;
    const auto picture = draw(scene, {8, 8});
    const plan::LayerPlan& plan = picture.info.plan.layers[0];
    EXPECT_EQ(plan.integrator, "user shader");
    EXPECT_EQ(plan.evaluator, plan::Evaluator::kMeshWalk);
    EXPECT_TRUE(plan.has(plan::kUserShader));
    EXPECT_TRUE(plan.has(plan::kStepEnlarged));
    EXPECT_FALSE(plan.has(plan::kSecondField));
}

TEST_F(UserShaderMesh, WhatIsWrongLeavesTheViewAsItWas) {
    use(box());
    scene::Scene scene = byCode(fromCorner(), fogCode(kReference));
    const auto good = draw(scene, {16, 16});
    const auto refused = [&](const scene::Scene& wrong) {
        const auto drawn = tryDraw(*renderer_, wrong, {16, 16});
        EXPECT_FALSE(drawn.has_value());
        return drawn ? std::string{} : drawn.error().message;
    };
    scene::Scene wrong = scene;
    wrong.layers[0].model = RayModel::kSurface;
    EXPECT_THAT(refused(wrong),
                HasSubstr("samples of volume, mip, minip and cross_sections show, not of surface"));
    wrong.layers[0].model = RayModel::kCrossSections;
    EXPECT_THAT(refused(wrong), HasSubstr("a mesh has none"));
    wrong = scene;
    wrong.layers[0].scale.kind = scene::Scale::Kind::kPower;
    EXPECT_THAT(refused(wrong), HasSubstr("code is given values as they are stored"));
    wrong = scene;
    wrong.layers[0].shader.code = "void main() { getDataValue(7); }";
    EXPECT_THAT(refused(wrong), HasSubstr("there is no field 7; \"mesh\" has 3, from 0"));
    EXPECT_EQ(largestDifference(good, draw(scene, {16, 16})), 0.0);
}

}  // namespace
}  // namespace volcast
