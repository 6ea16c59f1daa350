// Meshes, fields, maps and cameras that break careless arithmetic, against the reference.
#include <array>
#include <cmath>

#include "renderer/scene/ray_models.h"
#include "tests/support/against_reference.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Scene;
using support::orthographic;
using support::perspective;

constexpr scene::PictureSize kSize{32, 28};
constexpr std::array kModels{RayModel::kMip,   RayModel::kMinip, RayModel::kMipColour,
                             RayModel::kXray,  RayModel::kSplat, RayModel::kIsosurface,
                             RayModel::kVolume};

data::TransferFunction bentMap(float extinction = 1.0F) {
    return {{{.value = 0.1F, .colour = {0.1F, 0.2F, 1.0F}, .extinction = 0.0F},
             {.value = 0.4F, .colour = {0.2F, 1.0F, 0.4F}, .extinction = 2.0F * extinction},
             {.value = 0.5F, .colour = {1.0F, 0.6F, 0.1F}, .extinction = 0.1F * extinction},
             {.value = 0.9F, .colour = {0.9F, 0.1F, 0.3F}, .extinction = 3.0F * extinction}}};
}

/// Smooth in units of `size` about `center`.
support::PointFunction wave(const glm::dvec3& center, double size) {
    return [=](const glm::dvec3& p) {
        const glm::dvec3 q = (p - center) / size;
        return 0.5 + 0.4 * std::sin(3.0 * q.x + 1.0) * std::cos(2.0 * q.y - q.z);
    };
}

class HardMeshes : public support::ReferenceTest {
protected:
    /// Every model, from outside, seen along an axis, and from within.
    void expectAllModels(const glm::dvec3& center, double size, double tolerance,
                         const std::string& what) {
        const std::array cameras{
            perspective(center + size * glm::dvec3{1.7, 1.3, 2.4}, center),
            orthographic(center - glm::dvec3{0, 0, 3 * size}, center, 1.8 * size),
            perspective(center + size * glm::dvec3{0.11, -0.07, 0.05},
                        center + size * glm::dvec3{1, 0.4, -0.3}, 75.0)};
        for (const RayModel model : kModels) {
            for (const auto& camera : cameras) {
                Scene scene = sceneOf(camera, model, bentMap(static_cast<float>(1.0 / size)));
                scene.layers[0].levels = {.values = {0.35F, 0.62F}};
                scene.layers[0].extinctionScale = 0.5F;
                scene.layers[0].exposure = static_cast<float>(-std::log2(size)) - 1.0F;
                expectClose(scene, kSize, tolerance, what + ", " + std::string{scene::name(model)});
            }
        }
    }
};

// Rays of the orthographic camera run exactly through vertices and along edges and faces of the
// lattice; its coordinates are exact, so nothing but the integrals rounds.
TEST_F(HardMeshes, LatticesSeenAlongTheirAxes) {
    auto input = support::latticeMesh({.cubes = {4, 4, 4}, .low = {-1, -1, -1}, .high = {1, 1, 1}});
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    use(std::move(input));
    expectAllModels({0, 0, 0}, 1.0, 3e-4, "lattice");
}

// Flattened to a ten-thousandth in one cell in three: needles and slivers. A sliver's gradient is
// ten thousand times steeper across it, so that 1e-7 of the mesh is 1e-3 of its values' range where
// a picture shows a single value.
TEST_F(HardMeshes, Slivers) {
    const glm::ivec3 cubes{6, 5, 4};
    support::LatticeDesc desc{.cubes = cubes, .low = glm::dvec3{-1}, .high = glm::dvec3{1}};
    desc.move = [](const glm::dvec3& p) {
        const auto squeeze = [](double x) {
            const double cell = std::floor((x + 1.0) * 1.5 + 1e-9), within = (x + 1.0) * 1.5 - cell;
            return (cell + (within > 0.3 && within < 0.6 ? 1e-4 : within)) / 1.5 - 1.0;
        };
        return glm::dvec3{squeeze(p.x), p.y, squeeze(p.z)};
    };
    auto input = support::latticeMesh(desc);
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    use(std::move(input));
    expectAllModels({0, 0, 0}, 1.0, 2e-3, "slivers");
}

TEST_F(HardMeshes, FarFromTheOriginAndOfEverySize) {
    for (const auto& [center, size] :
         {std::pair{glm::dvec3{1e6, -2e6, 3e6}, 5.0}, std::pair{glm::dvec3{0, 0, 0}, 1e-6},
          std::pair{glm::dvec3{0, 0, 0}, 1e6}}) {
        const glm::ivec3 cubes{4, 5, 4};
        const glm::dvec3 low = center - size, high = center + size;
        auto input = support::latticeMesh({.cubes = cubes,
                                           .low = low,
                                           .high = high,
                                           .move = support::jitter(cubes, low, high, 0.13)});
        support::addField(input, "f", data::Association::kVertex, wave(center, size));
        use(std::move(input));
        expectAllModels(center, size, 3e-4, "size " + std::to_string(size));
    }
}

// Cells from 1e-6 to 1e6 in one mesh: planes of the lattice at 0, +-1e-6, +-1, +-1e6.
TEST_F(HardMeshes, CellsOfAllSizesInOneMesh) {
    support::LatticeDesc desc{.cubes = {6, 2, 2}, .low = {-3, -1, -1}, .high = {3, 1, 1}};
    desc.move = [](const glm::dvec3& p) {
        const std::array planes{-1e6, -1.0, -1e-6, 0.0, 1e-6, 1.0, 1e6};
        return glm::dvec3{planes.at(static_cast<std::size_t>(std::lround(p.x) + 3)), p.y * 1e6,
                          p.z * 1e6};
    };
    auto input = support::latticeMesh(desc);
    support::addField(input, "f", data::Association::kVertex,
                      [](const glm::dvec3& p) { return 0.5 + 0.3 * p.x / 1e6 + 0.1 * p.y / 1e6; });
    use(std::move(input));
    const auto camera = perspective({2.1e6, 1.3e6, 3.3e6}, {0, 0, 0});
    for (const RayModel model : kModels) {
        Scene scene = sceneOf(camera, model, bentMap(1e-6F));
        scene.layers[0].levels = {.values = {0.35F, 0.62F}};
        scene.layers[0].exposure = -21.0F;
        scene.layers[0].extinctionScale = 0.5F;
        expectClose(scene, kSize, 3e-4, std::string{scene::name(model)});
    }
}

// Zero-volume and inverted cells, doubled ones, faces of three cells, holes and loose parts.
TEST_F(HardMeshes, BrokenCells) {
    support::LatticeDesc desc{.cubes = {5, 4, 4}, .low = glm::dvec3{-1}, .high = glm::dvec3{1}};
    desc.move = support::jitter(desc.cubes, desc.low, desc.high, 0.1);
    desc.keep = [](const glm::ivec3& c) { return c.x != 2 && !(c.y == 1 && c.z == 1); };
    auto input = support::latticeMesh(desc);
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    for (std::size_t i = 0; i < input.cells.size(); i += 3) {
        std::swap(input.cells[i][0], input.cells[i][1]);
    }
    const auto first = input.cells.front();
    input.cells.push_back({first[0], first[1], first[2], first[0]});
    input.cells.push_back(first);
    use(std::move(input));
    EXPECT_GT(mesh_.cellsInverted, 0U);
    EXPECT_GT(mesh_.cellsWithoutVolume, 0U);
    EXPECT_GT(mesh_.cellsDoubled, 0U);
    expectAllModels({0, 0, 0}, 1.0, 3e-4, "broken cells");
}

TEST_F(HardMeshes, TheCameraOnAVertexOnAnEdgeAndOnAFace) {
    auto input = support::latticeMesh({.cubes = {4, 4, 4}, .low = {-1, -1, -1}, .high = {1, 1, 1}});
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    use(std::move(input));
    for (const glm::dvec3& eye : {glm::dvec3{0, 0, 0}, glm::dvec3{0.25, 0, 0},
                                  glm::dvec3{0.25, 0.25, 0.1}, glm::dvec3{0.5, -0.5, 0.5}}) {
        for (const RayModel model : {RayModel::kMip, RayModel::kXray, RayModel::kVolume}) {
            Scene scene =
                sceneOf(perspective(eye, eye + glm::dvec3{1, 0.31, 0.17}, 70.0), model, bentMap());
            // The eye is nudged by 4e-6 of its cell where it is on a face.
            expectClose(scene, kSize, 3e-4, std::string{scene::name(model)});
        }
    }
}

// Thin enough to be nothing in float32's 1 - exp(-x), and deep enough for a boundary layer of a
// millionth of a cell.
TEST_F(HardMeshes, TotalDepthsFromAMillionthToAMillion) {
    auto input = support::latticeMesh({.cubes = {3, 3, 3}, .low = {-1, -1, -1}, .high = {1, 1, 1}});
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    use(std::move(input));
    for (const float depth : {1e-6F, 1e-3F, 1.0F, 1e3F, 1e6F}) {
        for (const auto integrator : {scene::Integrator::kExact, scene::Integrator::kPsi}) {
            Scene scene =
                sceneOf(perspective({1.7, 1.3, 2.4}, {0, 0, 0}), RayModel::kVolume, bentMap(depth));
            scene.layers[0].integrator = integrator;
            const auto found = distance(scene, kSize);
            EXPECT_EQ(found.notFinite, 0) << depth;
            // psi does not see the map between both ends of a cell; it must only stay sound.
            const bool exact = integrator == scene::Integrator::kExact;
            EXPECT_LE(found.largest, exact ? 2e-4 * std::min(depth, 1.0F) : 1.0) << depth;
        }
    }
}

TEST_F(HardMeshes, FieldsOfEverySizeAndSign) {
    struct Case {
        float low, high;
    };
    for (const Case& c : {Case{1e30F, 3e30F}, Case{1e-30F, 3e-30F}, Case{-5.0F, -2.0F},
                          Case{-1e6F, 1e-3F}, Case{1e6F, 1e6F + 2.0F}}) {
        auto input =
            support::latticeMesh({.cubes = {4, 4, 4}, .low = {-1, -1, -1}, .high = {1, 1, 1}});
        const auto shape = wave({0, 0, 0}, 1.0);
        support::addField(input, "f", data::Association::kVertex, [&](const glm::dvec3& p) {
            return c.low + (static_cast<double>(c.high) - c.low) * shape(p);
        });
        use(std::move(input));
        for (const RayModel model : kModels) {
            data::TransferFunction map = bentMap();
            for (data::ControlPoint& point : map.points) {
                point.value = c.low + (c.high - c.low) * point.value;
            }
            Scene scene = sceneOf(perspective({1.7, 1.3, 2.4}, {0, 0, 0}), model, map);
            scene.layers[0].levels = {.values = {c.low + (c.high - c.low) * 0.35F}};
            expectClose(scene, kSize, 3e-4,
                        std::string{scene::name(model)} + " from " + std::to_string(c.low));
        }
    }
}

TEST_F(HardMeshes, MapsWithCoincidentAndNarrowPoints) {
    auto input = support::latticeMesh({.cubes = {4, 4, 4}, .low = {-1, -1, -1}, .high = {1, 1, 1}});
    support::addField(input, "f", data::Association::kVertex, wave({0, 0, 0}, 1.0));
    use(std::move(input));
    data::TransferFunction narrow = bentMap();
    narrow.points.insert(narrow.points.begin() + 2,
                         {{.value = 0.44F, .colour = {0, 0, 0}, .extinction = 0.0F},
                          {.value = 0.4400001F, .colour = {5, 5, 5}, .extinction = 4000.0F},
                          {.value = 0.4400002F, .colour = {0, 0, 0}, .extinction = 0.0F}});
    data::TransferFunction steps = bentMap();
    for (int i = 0; i < 3; ++i) {
        steps.points.insert(
            steps.points.begin() + 2,
            {.value = 0.4F, .colour = {0, 0, 1}, .extinction = 0.5F * static_cast<float>(i)});
    }
    data::TransferFunction one{{{.value = 0.4F, .colour = {0, 0, 1}, .extinction = 0.5F}}};
    for (const auto* map : {&narrow, &steps, &one}) {
        for (const RayModel model : {RayModel::kXray, RayModel::kSplat, RayModel::kVolume}) {
            // A peak 2e-7 wide is 3 float32 values wide: its place in a cell is known to a third.
            expectClose(sceneOf(perspective({1.7, 1.3, 2.4}, {0, 0, 0}), model, *map), kSize,
                        map == &narrow ? 2e-2 : 3e-4, std::string{scene::name(model)});
        }
    }
}

// A row of 70,000 slabs of cells: more than llvmpipe's 65,535 rounds of all loops of a ray.
TEST_F(HardMeshes, RaysOfMoreThan65535Steps) {
    auto input =
        support::latticeMesh({.cubes = {1, 1, 30000}, .low = {0, 0, 0}, .high = {1, 1, 300}});
    support::addField(input, "f", data::Association::kVertex,
                      [](const glm::dvec3& p) { return 0.5 + 0.4 * std::sin(0.05 * p.z); });
    use(std::move(input));
    ASSERT_GT(mesh_.cells.size(), 175'000U);
    const auto camera = orthographic({0.37, 0.41, -1}, {0.37, 0.41, 0}, 0.4);
    for (const RayModel model : {RayModel::kMip, RayModel::kXray, RayModel::kVolume}) {
        Scene scene = sceneOf(camera, model, bentMap(0.004F));
        scene.layers[0].extinctionScale = 1.0F;
        const auto found = distance(scene, {6, 6});
        // 90,000 sums of float32 with the largest 300 times the parts' mean.
        EXPECT_LE(found.largest, 5e-3) << scene::name(model);
        EXPECT_GT(found.pixels, 20);
    }
}

}  // namespace
}  // namespace volcast
