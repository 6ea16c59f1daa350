#pragma once

#include <cmath>
#include <vector>

#include "tests/support/delaunay.h"
#include "tests/support/mesh_scenes.h"
#include "tests/support/ray_caster.h"

/// What the tests of the projection share: meshes, fields, and a walk to compare with.
namespace volcast::support {

/// Bends, and an interval without extinction.
inline data::TransferFunction bentMap(float extinction) {
    return {{{.value = -0.8F, .colour = {0.1F, 0.3F, 0.9F}, .extinction = 0.4F * extinction},
             {.value = -0.2F, .colour = {0.2F, 0.8F, 0.4F}, .extinction = 0.0F},
             {.value = 0.1F, .colour = {0.9F, 0.9F, 0.2F}, .extinction = 0.0F},
             {.value = 0.3F, .colour = {0.9F, 0.2F, 0.1F}, .extinction = extinction},
             {.value = 0.7F, .colour = {0.3F, 0.1F, 0.6F}, .extinction = 0.2F * extinction}}};
}

/// `mesh` with fields p1, p0, d1 and g, which over [-1, 1]^3 are within [-1, 1].
inline data::MeshInput withFields(data::MeshInput mesh) {
    const auto wave = [](const glm::dvec3& p) {
        return 0.9 * std::sin(1.9 * p.x + 0.3) * std::cos(1.3 * p.y - 0.4) + 0.1 * p.z;
    };
    addField(mesh, "p1", data::Association::kVertex, wave);
    addField(mesh, "p0", data::Association::kCell, wave);
    addField(mesh, "d1", data::Association::kCellVertex,
             [&wave](const auto& p) { return 0.95 * wave(p) + 0.05 * std::sin(40.0 * p.x); });
    addField(mesh, "g", data::Association::kVertex,
             [](const auto& p) { return 0.4 * p.x - 0.3 * p.y + 0.25 * p.z; });
    return mesh;
}

struct Shape {
    const char* name;
    data::MeshInput mesh;
};

/// In [-1, 1]^3: convex and not Delaunay; Delaunay; with a hollow; in parts that touch.
inline const std::vector<Shape>& projectionShapes() {
    const glm::ivec3 n{5};
    const glm::dvec3 low{-1};
    const glm::dvec3 high{1};
    static const std::vector<Shape> kShapes{
        {"jittered",
         latticeMesh({.cubes = n, .low = low, .high = high, .move = jitter(n, low, high, 0.25)})},
        {"Delaunay", randomDelaunay(150, 5)},
        {"hollow", latticeMesh({.cubes = n,
                                .low = low,
                                .high = high,
                                .keep = [](const auto& c) { return c != glm::ivec3{2}; },
                                .move = jitter(n, low, high, 0.2)})},
        {"parts", latticeMesh({.cubes = n, .low = low, .high = high, .keep = [](const auto& c) {
                                   return c.x != 2 || (c.y == 1 && c.z == 3);
                               }})}};
    return kShapes;
}

struct View {
    const char* name;
    scene::Camera camera;
};

class ProjectionTest : public MeshTest {
protected:
    /// Layers that name no evaluator are drawn by `evaluator`.
    Drawn drawBy(scene::MeshEvaluator evaluator, scene::Scene scene, glm::ivec2 size = {33, 33}) {
        for (scene::Layer& layer : scene.layers) {
            if (layer.evaluator == scene::MeshEvaluator::kAuto) layer.evaluator = evaluator;
        }
        return draw(scene, size, 1 + static_cast<std::uint64_t>(evaluator));
    }

    /// Walk and projection differ by at most `tolerance` in every channel of every pixel.
    void expectAgreement(const scene::Scene& scene, double tolerance) {
        const Drawn walked = drawBy(scene::MeshEvaluator::kWalk, scene);
        const Drawn projected = drawBy(scene::MeshEvaluator::kProjection, scene);
        double sum = 0.0;
        int different = 0;
        for (std::size_t i = 0; i < walked.linear.size(); ++i) {
            ASSERT_TRUE(std::isfinite(projected.linear[i])) << i;
            sum += walked.linear[i];
            if (std::abs(walked.linear[i] - projected.linear[i]) <= tolerance) continue;
            if (different++ > 0) continue;
            ADD_FAILURE() << "channel " << i % 4 << " of pixel " << i / 4 << ": "
                          << walked.linear[i] << " and " << projected.linear[i];
        }
        EXPECT_EQ(different, 0);
        EXPECT_GT(sum, 1.0) << "there is nothing to compare";
    }

    /// Largest error of the lengths of rays in a mesh that fills the box; rays along its outline,
    /// which may see it or miss it, are left out.
    double worstLength(const scene::Camera& camera, glm::ivec2 size, const glm::dvec3& low,
                       const glm::dvec3& high) {
        constexpr float kThin = 1e-3F;
        const Drawn picture = drawBy(scene::MeshEvaluator::kProjection,
                                     sceneOf(camera, scene::RayModel::kVolume, fog(kThin)), size);
        const double hair = 1e-6 * glm::length(high - low);
        double worst = 0.0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const CastRay ray = pixelRay(camera, size, x, y);
                const auto inBox = [&](double more) {
                    return lengthInBox(ray.origin, ray.direction, low - more, high + more);
                };
                if (inBox(hair) > 0.0 && inBox(-hair) == 0.0) continue;
                worst = std::max(worst, std::abs(lengthOf(picture.at(x, y).a, kThin) - inBox(0.0)));
            }
        }
        return worst;
    }
};

}  // namespace volcast::support
