#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/reference/gather.h"
#include "renderer/reference/skew_ray.h"
#include "tests/unit/reference/scenes.h"

/// Cases of single segments and cells whose values are known to many digits. Control points are
/// float32, so values and colours are those of the cases times small integers.
namespace volcast::reference {
namespace {

const scene::ScaleFunction kIdentity{{}, {.min = 0.0F, .max = 1.0F}};

struct Point {
    float value, colour, extinction;
};
LinearMap mapOf(const std::vector<Point>& points) {
    data::TransferFunction map;
    for (const Point& p : points) {
        map.points.push_back(
            {.value = p.value, .colour = glm::vec3{p.colour}, .extinction = p.extinction});
    }
    return {map, kIdentity};
}

Part partOf(double f0, double f1, double length) {
    return {.front = 0.0, .length = length, .f0 = f0, .f1 = f1, .g0 = f0, .g1 = f1, .cell = 0};
}

TEST(HardCases, VolumeOfAPiecewiseLinearMap) {
    // Values times 20, colours times 10.
    const LinearMap colour = mapOf({{0, 1, 0}, {10, 10, 0}, {20, 3, 0}});
    const LinearMap extinction = mapOf({{0, 0, 0}, {8, 0, 0}, {10, 0, 10}, {12, 0, 0}, {20, 0, 2}});
    struct Case {
        double f0, f1, length, colour, alpha;
    };
    constexpr std::array kCases{Case{4, 16, 3, 0.91140270138259596, 0.99591322856153593},
                                Case{16, 4, 3, 0.82367800597108597, 0.99591322856153593},
                                Case{9, 11, 3, 0.92080559341997661, 0.99999999983081021},
                                Case{6, 9, 50, 0.83235643164366088, 1.0},
                                Case{1, 7.8, 7, 0.0, 0.0},
                                Case{10, 10, 0.25, 0.9179150013761012, 0.9179150013761012}};
    for (const Case& c : kCases) {
        std::vector<double> scratch;
        const std::array parts{partOf(c.f0, c.f1, c.length)};
        const glm::dvec4 found =
            volume(parts, {.colour = &colour, .extinction = &extinction}, scratch);
        EXPECT_NEAR(found.r / 10.0, c.colour, 1e-13) << c.f0 << " to " << c.f1;
        EXPECT_NEAR(found.a, c.alpha, 1e-13) << c.f0 << " to " << c.f1;
    }
}

TEST(HardCases, LargestColourIsThatOfPointsBetween) {
    const LinearMap tent = mapOf({{0, 0, 0}, {5, 1, 0}, {10, 0, 0}});
    const auto largest = [](const LinearMap& map, double f0, double f1) {
        return largestColour(std::array{partOf(f0, f1, 1.0)}, map).value().r;
    };
    EXPECT_EQ(largest(tent, 1, 9), 1.0);
    EXPECT_EQ(largest(tent, 5, 9), 1.0);
    EXPECT_NEAR(largest(tent, 6, 9), 0.8, 1e-15);
    EXPECT_NEAR(largest(tent, 2.5, 2.5), 0.5, 1e-15);
    const LinearMap narrow =
        mapOf({{0, 0, 0}, {0.49F, 0, 0}, {0.5F, 1, 0}, {0.51F, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(largest(narrow, 0, 1), 1.0);
    // What a step comes down from counts where it is passed, and not where values begin on it.
    const LinearMap cliff = mapOf({{0, 1, 0}, {5, 1, 0}, {5, 0.25F, 0}, {10, 0, 0}});
    EXPECT_EQ(largest(cliff, 4, 6), 1.0);
    EXPECT_EQ(largest(cliff, 4, 5), 1.0);
    EXPECT_EQ(largest(cliff, 5, 6), 0.25);
}

TEST(HardCases, MeansOfAPiecewiseLinearMap) {
    // Values times 4, colours (0, 0) (.25, 1) (.5, .2) (1, .6) times 5.
    const LinearMap map = mapOf({{0, 0, 0}, {1, 5, 5}, {2, 1, 1}, {4, 3, 3}});
    struct Case {
        double f0, f1, mean, transmittance;
    };
    constexpr std::array kCases{Case{0, 4, 0.475, 0.30498276871105929},
                                Case{0.4, 1.2, 0.755, 0.15144996085152656},
                                Case{1.2, 0.4, 0.755, 0.15144996085152656},
                                Case{0.96, 1.04, 0.982, 0.085863195441166832},
                                Case{1.2, 1.2, 0.84, 0.12245642825298191},
                                Case{1.2, 1.2000004, 0.83999984, 0.12245647723556301}};
    for (const Case& c : kCases) {
        std::vector<double> scratch;
        const std::array parts{partOf(c.f0, c.f1, 2.5)};
        const double sum = colourIntegral(parts, map, scratch).r / 5.0;
        EXPECT_NEAR(sum, 2.5 * c.mean, 1e-14) << c.f0 << " to " << c.f1;
        const double depth = opticalDepth(parts, map, scratch) / 5.0;
        EXPECT_NEAR(std::exp(-depth), c.transmittance, 1e-14) << c.f0 << " to " << c.f1;
    }
}

std::optional<LevelHit> hit(double f0, double f1, const std::vector<double>& levels) {
    Piece piece;
    piece.front.f = f0;
    piece.back = {.distance = 1.0, .f = f1, .g = 0.0, .face = {}};
    return firstLevel(std::array{piece}, {}, levels);
}

TEST(HardCases, LevelsAreTakenHalfOpen) {
    EXPECT_EQ(hit(0, 1, {0.25}).value().distance, 0.25);
    EXPECT_EQ(hit(1, 0, {0.25}).value().distance, 0.75);
    EXPECT_FALSE(hit(0.25, 1, {0.25}).has_value());
    EXPECT_EQ(hit(0.1, 0.25, {0.25}).value().distance, 1.0);
    EXPECT_FALSE(hit(0.25, 0.25, {0.25}).has_value());
    const auto up = hit(0.2, 0.9, {0.3, 0.5, 0.8});
    EXPECT_EQ(up.value().level, 0.3);
    EXPECT_NEAR(up->distance, 1.0 / 7.0, 1e-15);
    const auto down = hit(0.9, 0.2, {0.3, 0.5, 0.8});
    EXPECT_EQ(down.value().level, 0.8);
    EXPECT_NEAR(down->distance, 1.0 / 7.0, 1e-15);
}

std::optional<Piece> inTet(const std::array<glm::vec3, 4>& corners, const glm::dvec3& origin,
                           const glm::dvec3& direction, const glm::dvec3& meshOrigin = {}) {
    data::Mesh mesh;
    mesh.vertices = std::vector<glm::vec3>{corners.begin(), corners.end()};
    mesh.cells = std::vector<glm::ivec4>{{0, 1, 2, 3}};
    return SkewRay{{.origin = origin, .direction = direction}, meshOrigin}.through(mesh, 0, {}, {});
}

std::array<glm::vec3, 4> tet(float size, float height) {
    return {glm::vec3{0}, {size, 0, 0}, {0, size, 0}, {0, 0, height}};
}

TEST(HardCases, OneCell) {
    const auto axis = inTet(tet(1, 1), {0.25, 0.25, -1}, {0, 0, 1});
    EXPECT_EQ(axis.value().front.distance, 1.0);
    EXPECT_EQ(axis->back.distance, 1.5);
    const auto sliver = inTet(tet(1, 1e-6F), {0.25, 0.25, -1e-6}, {0, 0, 1});
    const double half = 0.5 * 1e-6F;
    EXPECT_NEAR(sliver.value().back.distance - sliver->front.distance, half, 1e-15 * half);
    const auto far = inTet(tet(1, 1e-6F), {0.25, 0.25, -3}, {0, 0, 1});
    EXPECT_NEAR(far.value().back.distance - far->front.distance, half, 1e-15);
    const auto offset =
        inTet(tet(1000, 1000), {1e6 + 250, 1e6 + 250, 1e6 - 1000}, {0, 0, 1}, glm::dvec3{1e6});
    EXPECT_EQ(offset.value().front.distance, 1000.0);
    EXPECT_EQ(offset->back.distance, 1500.0);
    const auto inside = inTet(tet(1, 1), {0.125, 0.125, 0.125}, {0, 0, 1});
    EXPECT_EQ(inside.value().front.distance, -0.125);
    EXPECT_EQ(inside->back.distance, 0.625);
}

TEST(HardCases, ACellWithoutVolumeHasNoLength) {
    const std::array<glm::vec3, 4> flat{glm::vec3{0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    for (const glm::dvec3& direction :
         {glm::dvec3{0, 0, 1}, glm::dvec3{1, 0, 0}, glm::normalize(glm::dvec3{1, 2, 3})}) {
        const auto piece = inTet(flat, glm::dvec3{0.3, 0.4, 0.0} - 2.0 * direction, direction);
        if (!piece) continue;
        EXPECT_NEAR(piece->back.distance, piece->front.distance, 1e-15);
    }
    EXPECT_TRUE(inTet(flat, {0.3, 0.4, -2.0}, {0, 0, 1}).has_value());
}

}  // namespace
}  // namespace volcast::reference
