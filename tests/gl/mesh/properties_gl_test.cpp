// What must not change a picture.
#include <cmath>

#include "renderer/scene/ray_models.h"
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Scene;
using support::perspective;

constexpr scene::PictureSize kSize{40, 36};

data::TransferFunction bentMap(float extinction = 1.0F) {
    return {{{.value = 0.1F, .colour = {0.1F, 0.2F, 1.0F}, .extinction = 0.0F},
             {.value = 0.4F, .colour = {0.2F, 1.0F, 0.4F}, .extinction = 2.0F * extinction},
             {.value = 0.9F, .colour = {0.9F, 0.1F, 0.3F}, .extinction = 3.0F * extinction}}};
}

class MeshProperties : public support::MeshTest {
protected:
    static data::MeshInput box(double unit,
                               const std::function<bool(const glm::ivec3&)>& keep = {}) {
        const glm::ivec3 cubes{6, 5, 4};
        const glm::dvec3 low{-unit}, high{unit};
        auto input = support::latticeMesh({.cubes = cubes,
                                           .low = low,
                                           .high = high,
                                           .keep = keep,
                                           .move = support::jitter(cubes, low, high, 0.12)});
        support::addField(input, "f", data::Association::kVertex, [unit](const glm::dvec3& p) {
            const glm::dvec3 q = p / unit;
            return 0.5 + 0.4 * std::sin(3.0 * q.x + 1.0) * std::cos(2.0 * q.y - q.z);
        });
        return input;
    }

    static Scene sceneIn(RayModel model, double unit) {
        Scene scene = sceneOf(perspective(unit * glm::dvec3{1.9, 1.4, 2.6}, {0, 0, 0}), model,
                              bentMap(static_cast<float>(1.0 / unit)));
        scene.layers[0].coloured = true;
        scene.layers[0].levels = {.values = {0.35F, 0.6F}};
        scene.layers[0].exposure = static_cast<float>(-std::log2(unit)) - 1.0F;
        return scene;
    }

    static double largest(const support::Drawn& a, const support::Drawn& b) {
        double difference = 0.0;
        for (std::size_t i = 0; i < a.linear.size(); ++i) {
            difference = std::max(difference, std::abs(static_cast<double>(a.linear[i]) -
                                                       static_cast<double>(b.linear[i])));
        }
        return difference;
    }
};

TEST_F(MeshProperties, OrderAndOrientationOfCellsChangeNothing) {
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onMeshes) continue;
        use(box(1.0));
        const auto before = draw(sceneIn(row.model, 1.0), kSize);
        auto input = support::shuffled(box(1.0), 7);
        for (std::size_t i = 0; i < input.cells.size(); i += 2) {
            std::swap(input.cells[i][1], input.cells[i][2]);
        }
        use(std::move(input));
        // Cells have one order and one orientation however a file holds them: the same bits.
        EXPECT_EQ(largest(before, draw(sceneIn(row.model, 1.0), kSize)), 0.0) << row.name;
    }
}

// A power of two changes no mantissa; a thousand rounds every coordinate once more, by 6e-8 of the
// mesh, which the steepest of what is shown (200 a length of the mesh) makes 1e-5.
TEST_F(MeshProperties, UnitsChangeNothing) {
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onMeshes || row.chunk.empty()) continue;
        use(box(1.0));
        const auto before = draw(sceneIn(row.model, 1.0), kSize);
        use(box(1024.0));
        EXPECT_LE(largest(before, draw(sceneIn(row.model, 1024.0), kSize)), 1e-6) << row.name;
        use(box(1000.0));
        EXPECT_LE(largest(before, draw(sceneIn(row.model, 1000.0), kSize)), 5e-5) << row.name;
    }
}

// Two halves composited are the whole: the eye sees all of the near half before the far one.
TEST_F(MeshProperties, TwoHalvesAreTheWhole) {
    use(box(1.0));
    const auto camera = support::orthographic({0.3, 0.2, 5}, {0.3, 0.2, 0}, 3.0);
    Scene scene = sceneIn(RayModel::kVolume, 1.0);
    scene.camera = camera;
    const auto whole = draw(scene, kSize);
    const auto half = [&](bool near) {
        use(box(1.0, [near](const glm::ivec3& c) { return (c.z >= 2) == near; }));
        Scene own = sceneIn(RayModel::kVolume, 1.0);
        own.camera = camera;
        return draw(own, kSize);
    };
    const auto front = half(true), back = half(false);
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x; ++x) {
            const glm::vec4 both = front.at(x, y) + (1.0F - front.at(x, y).a) * back.at(x, y);
            for (int c = 0; c < 4; ++c) {
                // 100 pieces of float32 in either case.
                EXPECT_NEAR(both[c], whole.at(x, y)[c], 2e-5) << x << ' ' << y;
            }
        }
    }
}

// What the plan leaves out does not show: forced on, the picture is the same.
TEST_F(MeshProperties, ReducedPlansDrawTheSamePicture) {
    use(box(1.0));
    // One colour: only opacity is gathered. A second point of another colour that no value reaches
    // forces the full program.
    Scene reduced = sceneIn(RayModel::kVolume, 1.0);
    for (auto& point : reduced.layers[0].map.points) point.colour = {0.3F, 0.6F, 0.9F};
    Scene full = reduced;
    full.layers[0].map.points.push_back({.value = 5.0F, .colour = {1, 0, 0}, .extinction = 3.0F});
    auto& tail = full.layers[0].map.points;
    tail.insert(tail.end() - 1, {.value = 4.0F, .colour = {0.3F, 0.6F, 0.9F}, .extinction = 3.0F});
    const auto a = draw(reduced, kSize), b = draw(full, kSize);
    EXPECT_FALSE(a.info.plan.layers[0].has("colours"));
    EXPECT_TRUE(b.info.plan.layers[0].has("colours"));
    EXPECT_LE(largest(a, b), 2e-6);
    // A second field that is the first again costs nothing and changes nothing.
    Scene doubled = sceneIn(RayModel::kVolume, 1.0);
    const auto single = draw(doubled, kSize, 2);
    doubled.layers[0].densityField = "f";
    const auto same = draw(doubled, kSize, 2);
    EXPECT_FALSE(same.info.plan.layers[0].has("second field"));
    EXPECT_EQ(same.info.work.bufferUploads, 0U);
    EXPECT_EQ(largest(single, same), 0.0);
}

}  // namespace
}  // namespace volcast
