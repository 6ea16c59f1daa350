// The projection draws what the walk draws: two ways to bring rays and cells together, one picture.
#include <cmath>

#include "renderer/scene/ray_models.h"
#include "tests/support/delaunay.h"
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using data::Association;
using scene::Integrator;
using scene::MeshEvaluator;
using scene::RayModel;
using support::addField;
using support::Drawn;
using support::latticeMesh;
using support::orthographic;
using support::perspective;

/// A smooth field without symmetry; over [-1, 1]^3 within [-1, 1].
double wave(const glm::dvec3& p) {
    return 0.9 * std::sin(1.9 * p.x + 0.3) * std::cos(1.3 * p.y - 0.4) + 0.1 * p.z;
}
double slope(const glm::dvec3& p) {
    return 0.4 * p.x - 0.3 * p.y + 0.25 * p.z;
}

/// Bends, and an interval without extinction.
data::TransferFunction bentMap(float extinction) {
    return {{{.value = -0.8F, .colour = {0.1F, 0.3F, 0.9F}, .extinction = 0.4F * extinction},
             {.value = -0.2F, .colour = {0.2F, 0.8F, 0.4F}, .extinction = 0.0F},
             {.value = 0.1F, .colour = {0.9F, 0.9F, 0.2F}, .extinction = 0.0F},
             {.value = 0.3F, .colour = {0.9F, 0.2F, 0.1F}, .extinction = extinction},
             {.value = 0.7F, .colour = {0.3F, 0.1F, 0.6F}, .extinction = 0.2F * extinction}}};
}

data::MeshInput withFields(data::MeshInput mesh) {
    addField(mesh, "p1", Association::kVertex, wave);
    addField(mesh, "p0", Association::kCell, wave);
    addField(mesh, "d1", Association::kCellVertex,
             [](const auto& p) { return wave(p) + 0.05 * std::sin(40.0 * p.x); });
    addField(mesh, "g", Association::kVertex, slope);
    return mesh;
}

struct Shape {
    const char* name;
    data::MeshInput mesh;
};

const std::vector<Shape>& shapes() {
    const glm::ivec3 n{5};
    const glm::dvec3 low{-1};
    const glm::dvec3 high{1};
    static const std::vector<Shape> kShapes{
        {"jittered", latticeMesh({.cubes = n,
                                  .low = low,
                                  .high = high,
                                  .move = support::jitter(n, low, high, 0.25)})},
        {"Delaunay", support::randomDelaunay(150, 5)},
        {"hollow", latticeMesh({.cubes = n,
                                .low = low,
                                .high = high,
                                .keep = [](const auto& c) { return c != glm::ivec3{2}; },
                                .move = support::jitter(n, low, high, 0.2)})},
        {"parts", latticeMesh({.cubes = n, .low = low, .high = high, .keep = [](const auto& c) {
                                   return c.x != 2 || (c.y == 1 && c.z == 3);
                               }})}};
    return kShapes;
}

struct View {
    const char* name;
    scene::Camera camera;
};

const std::vector<View>& views() {
    static const std::vector<View> kViews{
        {"perspective", perspective({3.1, 2.3, 4.4}, {0, 0, 0})},
        {"orthographic", orthographic({-1.3, 4.1, 2.2}, {0, 0, 0}, 3.0)},
        {"inside", perspective({0.31, -0.17, 0.53}, {-0.4, 0.2, -0.3}, 80.0)},
        {"plane within", orthographic({0.2, 0.1, 0.15}, {-0.5, 0.3, -1}, 2.5)}};
    return kViews;
}

class Projection : public support::MeshTest {
protected:
    Drawn drawBy(MeshEvaluator evaluator, scene::Scene scene, glm::ivec2 size) {
        for (scene::Layer& layer : scene.layers) {
            if (layer.model != RayModel::kSurface) layer.evaluator = evaluator;
        }
        return draw(scene, size, 1 + static_cast<std::uint64_t>(evaluator));
    }
    /// Largest difference of a channel between walk and projection.
    double difference(const scene::Scene& scene, glm::ivec2 size = {33, 33}) {
        const Drawn walked = drawBy(MeshEvaluator::kWalk, scene, size);
        const Drawn projected = drawBy(MeshEvaluator::kProjection, scene, size);
        double worst = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < walked.linear.size(); ++i) {
            EXPECT_TRUE(std::isfinite(projected.linear[i])) << i;
            sum += walked.linear[i];
            worst = std::max(worst, std::abs(static_cast<double>(walked.linear[i]) -
                                             static_cast<double>(projected.linear[i])));
        }
        EXPECT_GT(sum, 1.0) << "there is nothing to compare";
        return worst;
    }
};

TEST_F(Projection, AgreesWithTheWalkForEveryModelAndIntegrator) {
    for (const Shape& shape : shapes()) {
        use(withFields(shape.mesh));
        for (const View& view : views()) {
            for (const scene::RayModelRow& row : scene::rayModels()) {
                if (!row.onMeshes || row.chunk.empty()) continue;
                for (const scene::IntegratorRow& integrator : row.integrators) {
                    scene::Scene scene = sceneOf(view.camera, row.model, bentMap(3.0F), "p1");
                    scene.layers[0].integrator = integrator.integrator;
                    scene.layers[0].levels = {.values = {-0.4F, 0.0F, 0.2F, 0.5F}};
                    const double d = difference(scene);
                    std::printf("%s %s %s %s: %g\n", shape.name, view.name, std::string{row.name}.c_str(), std::string{integrator.name}.c_str(), d);
                    EXPECT_LT(d, 1e-3);
                }
            }
        }
    }
}

}  // namespace
}  // namespace volcast
