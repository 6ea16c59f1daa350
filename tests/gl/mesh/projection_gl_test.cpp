// The projection draws what the walk draws: two ways to bring rays and cells together, one picture.
#include <cmath>

#include "renderer/scene/ray_models.h"
#include "tests/support/delaunay.h"
#include "tests/support/projection_test.h"

namespace volcast {
namespace {

using scene::MeshEvaluator;
using scene::RayModel;
using support::bentMap;
using support::Drawn;
using support::fog;
using support::latticeMesh;
using support::lengthInBox;
using support::lengthOf;
using support::orthographic;
using support::perspective;
using support::pixelRay;
using support::View;

// Both evaluators take a piece's ends from the same areas; they differ in the order of their sums.
// That is a relative 1e-7 for each of some 30 pieces, of values up to 4 (splat): 1.2e-5.
constexpr double kRounding = 2e-5;

class Projection : public support::ProjectionTest {};

const std::vector<View>& views() {
    static const std::vector<View> kViews{
        {"perspective", perspective({3.1, 2.3, 4.4}, {0, 0, 0})},
        {"orthographic", orthographic({-1.3, 4.1, 2.2}, {0, 0, 0}, 3.0)},
        {"inside", perspective({0.31, -0.17, 0.53}, {-0.4, 0.2, -0.3}, 80.0)},
        {"plane within", orthographic({0.2, 0.1, 0.15}, {-0.5, 0.3, -1}, 2.5)}};
    return kViews;
}

TEST_F(Projection, AgreesWithTheWalkForEveryModelAndIntegrator) {
    for (const support::Shape& shape : support::projectionShapes()) {
        const bool first = &shape == &support::projectionShapes().front();
        use(support::withFields(shape.mesh));
        for (const View& view : views()) {
            for (const scene::RayModelRow& row : scene::rayModels()) {
                if (row.chunk.empty()) continue;
                for (const scene::IntegratorRow& integrator : row.integrators) {
                    if (!first && &integrator != &row.integrators.back()) continue;
                    SCOPED_TRACE(std::string{shape.name} + ", " + view.name + ", " +
                                 std::string{row.name} + ", " + std::string{integrator.name});
                    scene::Scene scene = sceneOf(view.camera, row.model, bentMap(3.0F), "p1");
                    scene.layers[0].integrator = integrator.integrator;
                    scene.layers[0].levels = {.values = {-0.4F, 0.0F, 0.2F, 0.5F}};
                    expectAgreement(scene, kRounding);
                }
            }
        }
    }
}

TEST_F(Projection, AgreesWithTheWalkForFieldsOfEveryKind) {
    use(support::withFields(support::projectionShapes()[2].mesh));
    for (const char* field : {"p0", "d1", "p1"}) {
        for (const char* density : {"", "g", "p0"}) {
            for (const RayModel model :
                 {RayModel::kVolume, RayModel::kXray, RayModel::kIsosurface, RayModel::kMip}) {
                // A mip has no use for a second field; one value a cell takes no level.
                if (model == RayModel::kMip && *density != '\0') continue;
                if (model == RayModel::kIsosurface && field == std::string{"p0"}) continue;
                SCOPED_TRACE(std::string{field} + ", " + density + ", " +
                             std::string{scene::name(model)});
                scene::Scene scene = sceneOf(views()[0].camera, model, bentMap(3.0F), field);
                scene.layers[0].densityField = density;
                scene.layers[0].levels = {.values = {-0.3F, 0.2F}};
                expectAgreement(scene, kRounding);
            }
        }
    }
}

TEST_F(Projection, AgreesWithTheWalkWhereRaysAreCut) {
    use(support::withFields(support::projectionShapes()[2].mesh));
    for (const View& view : views()) {
        for (const RayModel model :
             {RayModel::kVolume, RayModel::kMip, RayModel::kMipColour, RayModel::kIsosurface}) {
            SCOPED_TRACE(std::string{view.name} + ", " + std::string{scene::name(model)});
            scene::Scene plain = sceneOf(view.camera, model, bentMap(3.0F), "p1");
            plain.layers[0].levels = {.values = {-0.3F, 0.2F}};
            scene::Scene cut = plain;
            cut.clipPlanes = {{.normal = {1, 0.2, 0.3}, .offset = -0.5},
                              {.normal = {-0.4, 0.1, -2}, .offset = -1.3}};
            expectAgreement(cut, kRounding);
            cut = plain;
            cut.layers[0].interval = data::Range{.min = -0.25F, .max = 0.35F};
            expectAgreement(cut, kRounding);
            if (model == RayModel::kIsosurface) continue;
            cut = plain;
            cut.layers.push_back(cut.layers[0]);
            cut.layers[1].id = "levels";
            cut.layers[1].model = RayModel::kIsosurface;
            cut.layers[1].evaluator = MeshEvaluator::kProjection;  // No walk can draw both at once.
            expectAgreement(cut, kRounding);
        }
    }
}

// Where many cells meet a line at once: rays through vertices, along edges and within faces.
TEST_F(Projection, LatticeAlongAxesAndDiagonalsHasExactLengths) {
    const int n = 4;
    use(latticeMesh({.cubes = {n, n, n}, .low = glm::dvec3{-2}, .high = glm::dvec3{2}}));
    for (const glm::dvec3 direction :
         {glm::dvec3{0, 0, 1}, glm::dvec3{-1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{1, 1, 1},
          glm::dvec3{1, 1, 0}, glm::dvec3{1, 2, 0}}) {
        // Pixels on lattice planes and halfway between, at quarters, and at neither.
        for (const auto& [pixels, height] :
             {std::pair{2 * n + 1, n + 0.5}, std::pair{2 * n + 2, n + 1.0}, std::pair{33, 7.0}}) {
            const glm::dvec3 up = direction.z == 1.0 && direction.x == 0.0 ? glm::dvec3{0, 1, 0}
                                                                           : glm::dvec3{0, 0, 1};
            const auto camera = orthographic(-10.0 * direction, {0, 0, 0}, height, up);
            EXPECT_LT(worstLength(camera, {pixels, pixels}, glm::dvec3{-2}, glm::dvec3{2}),
                      kRounding)
                << direction.x << ' ' << direction.y << ' ' << direction.z << ' ' << pixels;
        }
    }
}

// Faces that the plane of the eye cuts have no outline; those of the eye's own cell are all around.
TEST_F(Projection, EyeInACellOnAVertexOnAnEdgeAndOnAFace) {
    use(latticeMesh({.cubes = {4, 4, 4}, .low = glm::dvec3{-2}, .high = glm::dvec3{2}}));
    for (const glm::dvec3 eye :
         {glm::dvec3{0.31, 0.17, -0.73}, glm::dvec3{0, 0, 0}, glm::dvec3{0.5, 0, 0},
          glm::dvec3{0.25, 0.5, 0}, glm::dvec3{0.5, 0.5, 0.5}, glm::dvec3{2, 0.3, 0.2}}) {
        for (const glm::dvec3 view : {glm::dvec3{0, 0, -1}, glm::dvec3{1, 0.4, 0.2}}) {
            for (const double fovy : {20.0, 90.0, 150.0}) {
                const auto camera = perspective(eye, eye + view, fovy);
                EXPECT_LT(worstLength(camera, {33, 33}, glm::dvec3{-2}, glm::dvec3{2}), 3e-5)
                    << eye.x << ' ' << eye.y << ' ' << eye.z << " to " << view.x << ", " << fovy;
            }
        }
    }
}

TEST_F(Projection, UnitsAndPlacesDoNotMatter) {
    struct Place {
        double unit;
        glm::dvec3 middle;
    };
    for (const Place& place :
         {Place{1e-12, {0, 0, 0}}, Place{1e12, {0, 0, 0}}, Place{5.0, {1e6, -1e6, 2e6}}}) {
        use(latticeMesh({.cubes = {4, 4, 4},
                         .low = place.middle - place.unit,
                         .high = place.middle + place.unit}));
        const auto camera =
            perspective(place.middle + glm::dvec3{3, 2, 5} * place.unit, place.middle);
        const auto extinction = static_cast<float>(0.1 / place.unit);
        expectAgreement(sceneOf(camera, RayModel::kVolume, fog(extinction)), kRounding);
    }
}

TEST_F(Projection, DenseMatterEndsRaysAtItsFirstCell) {
    use(support::withFields(support::projectionShapes()[0].mesh));
    for (const float extinction : {1e3F, 1e6F}) {
        expectAgreement(sceneOf(views()[0].camera, RayModel::kVolume, bentMap(extinction), "p1"),
                        kRounding);
    }
}

// The values at all faces are the values at both ends of all pieces, and computed alike.
TEST_F(Projection, AllFacesGiveTheBitsOfFrontFacesAndTheirExits) {
    for (const support::Shape& shape : support::projectionShapes()) {
        use(support::withFields(shape.mesh));
        for (const View& view : views()) {
            for (const RayModel model : {RayModel::kMip, RayModel::kMinip, RayModel::kMipColour}) {
                for (const char* field : {"p1", "p0", "d1"}) {
                    scene::Scene scene = sceneOf(view.camera, model, bentMap(1.0F), field);
                    if (model == RayModel::kMipColour) {
                        scene.layers[0].integrator = scene::Integrator::kEnds;
                    }
                    const Drawn front = drawBy(MeshEvaluator::kProjection, scene);
                    const Drawn all = drawBy(MeshEvaluator::kProjectionFaces, scene);
                    EXPECT_EQ(all.info.plan.layers[0].evaluator,
                              plan::Evaluator::kMeshProjectionFaces);
                    EXPECT_EQ(front.linear, all.linear) << shape.name << ", " << view.name << ", "
                                                        << scene::name(model) << ", " << field;
                }
            }
        }
    }
}

TEST_F(Projection, OrderOfCellsInTheFileChangesNoBit) {
    const data::MeshInput input = support::withFields(support::projectionShapes()[2].mesh);
    const scene::Scene scene = sceneOf(views()[0].camera, RayModel::kVolume, bentMap(3.0F), "p1");
    use(input);
    const Drawn before = drawBy(MeshEvaluator::kProjection, scene);
    use(support::shuffled(input, 11));
    EXPECT_EQ(drawBy(MeshEvaluator::kProjection, scene).linear, before.linear);
}

}  // namespace
}  // namespace volcast
