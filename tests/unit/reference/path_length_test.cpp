#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "renderer/reference/caster.h"
#include "tests/unit/reference/scenes.h"

/// The lengths of a ray's pieces add up to its length in the mesh.
namespace volcast::reference {
namespace {

constexpr double kEverywhere = 1e30;

std::vector<Piece> piecesOf(const Caster& caster, const Ray& ray) {
    std::vector<Piece> pieces;
    caster.trace(ray, {.begin = -kEverywhere, .end = kEverywhere}, {}, {}, {}, pieces);
    return pieces;
}

double sumOf(const std::vector<Piece>& pieces) {
    double sum = 0.0;
    for (const Piece& piece : pieces) sum += piece.back.distance - piece.front.distance;
    return sum;
}

/// Length of a line in the box [0, n]^3; `inSide`: whether it runs in one of its sides.
double inBox(const Ray& ray, double n, bool& inSide) {
    double front = -kEverywhere, back = kEverywhere;
    inSide = false;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = ray.origin[axis], rate = ray.direction[axis];
        if (rate == 0.0) {
            if (at < 0.0 || at > n) return 0.0;
            inSide = inSide || at == 0.0 || at == n;
            continue;
        }
        front = std::max(front, std::min(-at / rate, (n - at) / rate));
        back = std::min(back, std::max(-at / rate, (n - at) / rate));
    }
    return std::max(back - front, 0.0);
}

TEST(PathLength, IsThatOfTheBoxInAllLatticeDirections) {
    constexpr int kCubes = 3;
    const data::Mesh mesh = test::boxOf(
        {.cubes = glm::ivec3{kCubes}, .low = glm::dvec3{0.0}, .high = glm::dvec3{kCubes}},
        [](const auto&) { return 0.0; });
    const Caster caster{mesh};
    int rays = 0;
    for (int d = 0; d < 125; ++d) {
        const glm::dvec3 direction{d % 5 - 2, d / 5 % 5 - 2, d / 25 - 2};
        if (direction == glm::dvec3{0.0}) continue;
        for (int o = 0; o < 343; ++o) {
            // Lattice and half-lattice points; a direction of any length, so that it is exact.
            const Ray ray{.origin = 0.5 * glm::dvec3{o % 7, o / 7 % 7, o / 49},
                          .direction = direction};
            bool inSide = false;
            const double expected = inBox(ray, kCubes, inSide);
            const auto pieces = piecesOf(caster, ray);
            const double found = sumOf(pieces);
            // A ray in a side is moved in or out as a whole.
            if (inSide && pieces.empty()) continue;
            ASSERT_NEAR(found, expected, 1e-14 * kCubes) << "direction " << d << " origin " << o;
            for (std::size_t i = 1; i < pieces.size(); ++i) ASSERT_TRUE(pieces[i].joined);
            ++rays;
        }
    }
    EXPECT_GT(rays, 30000);
}

TEST(PathLength, IsThatOfTheBoxWhereCellsAreMovedAndTheRayIsAnyRay) {
    const glm::dvec3 low{-1.0}, high{1.0};
    const glm::ivec3 cubes{6, 5, 7};
    const data::Mesh mesh = test::boxOf(
        {.cubes = cubes, .low = low, .high = high, .move = support::jitter(cubes, low, high, 0.2)},
        [](const auto&) { return 0.0; });
    const Caster caster{mesh};
    std::mt19937 random{3};
    std::normal_distribution<double> normal;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
        // Through a vertex, an edge, a face or a cell of the mesh.
        glm::dvec3 target{0.0};
        const int corners = i % 4 + 1;
        const auto cell = static_cast<std::size_t>(i * 7919L) % mesh.cells.size();
        for (int c = 0; c < corners; ++c) {
            target += glm::dvec3{mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][c])]};
        }
        const Ray ray{.origin = mesh.origin + target / double(corners) - 3.0 * direction,
                      .direction = direction};
        const auto pieces = piecesOf(caster, ray);
        bool inSide = false;
        // [-1, 1]^3 is [0, 2]^3 moved by 1. Points are rounded to 2^-24 of 1; a ray at a flat angle
        // to a side gains the more.
        const double flattest =
            std::min({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
        const double expected =
            inBox({.origin = ray.origin + 1.0, .direction = direction}, 2.0, inSide);
        ASSERT_NEAR(sumOf(pieces), expected, 4.0 * 6e-8 / flattest) << i;
        for (std::size_t k = 1; k < pieces.size(); ++k) ASSERT_TRUE(pieces[k].joined) << i;
    }
}

TEST(PathLength, IsThatOfTheBoxWhereCellsAreNeedles) {
    // Sides of 2^-20, 1 and 2^20; everything is exact but the shear.
    const glm::ivec3 cubes{4};
    const glm::dvec3 sides{0x1p-20, 1.0, 0x1p20};
    const data::Mesh mesh = test::boxOf({.cubes = cubes, .low = glm::dvec3{0.0}, .high = sides},
                                        [](const auto&) { return 0.0; });
    const Caster caster{mesh};
    std::mt19937 random{4};
    std::uniform_real_distribution<double> share{-1.0, 1.0};
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 way{share(random), share(random), share(random)};
        const glm::dvec3 target{0.5 + 0.5 * share(random), 0.5 + 0.5 * share(random), 0.5};
        const double length = glm::length(way * sides);
        const Ray ray{.origin = (target - 2.0 * way) * sides, .direction = way * sides / length};
        bool inSide = false;
        const double expected =
            length * inBox({.origin = target - 2.0 * way, .direction = way}, 1.0, inSide);
        const auto pieces = piecesOf(caster, ray);
        // Distances of up to some 2^21 are rounded to 2^-32, at most a few times a piece.
        ASSERT_NEAR(sumOf(pieces), expected, 1e-8 + 1e-12 * expected) << i;
        for (std::size_t k = 1; k < pieces.size(); ++k) ASSERT_TRUE(pieces[k].joined) << i;
    }
}

TEST(PathLength, IsThatOfTheBoxWhereFloatsTurnCellsInsideOut) {
    // A layer of 1e-9, turned so that rounding to float32 throws its corners about; its field keeps
    // corners apart that coincide then.
    const glm::dmat3 turn{glm::normalize(glm::dvec3{1, 2, 2}),
                          glm::normalize(glm::dvec3{-2, -1, 2}),
                          glm::normalize(glm::dvec3{2, -2, 1})};
    constexpr double kLayer = 1.0 / 3.0;
    const data::Mesh mesh = test::boxOf(
        {.cubes = glm::ivec3{3},
         .move =
             [&](glm::dvec3 p) {
                 if (p.z > 0.5 && p.z < 0.9) {
                     p.z = kLayer + 1e-9;
                     if (p.x > 0.1 && p.x < 0.9) p.x += 0.05;
                     if (p.y > 0.1 && p.y < 0.9) p.y += 0.03;
                 }
                 return turn * p;
             }},
        [&](const auto& p) { return glm::dot(turn[2], p) > kLayer + 5e-10 ? 1.0 : 0.0; });
    const Caster caster{mesh};
    std::mt19937 random{5};
    std::uniform_real_distribution<double> share{0.05, 0.95};
    int turned = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 from{share(random), share(random), -1.0};
        const glm::dvec3 to{share(random), share(random), 2.0};
        const glm::dvec3 way = glm::normalize(to - from);
        const auto pieces = piecesOf(caster, {.origin = turn * from, .direction = turn * way});
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            turned += pieces[k].back.distance < pieces[k].front.distance ? 1 : 0;
            ASSERT_TRUE(k == 0 || pieces[k].joined) << i;
        }
        bool inSide = false;
        const double expected = inBox({.origin = from, .direction = way}, 1.0, inSide);
        ASSERT_NEAR(sumOf(pieces), expected, 4.0 * 6e-8 / std::abs(way.z) * 3.0) << i;
    }
    EXPECT_GT(turned, 100);
}

TEST(PathLength, OfAVeryLongRay) {
    constexpr int kCubes = 30000;
    const data::Mesh mesh =
        test::boxOf({.cubes = {1, 1, kCubes}, .low = glm::dvec3{0.0}, .high = {1, 1, kCubes}},
                    [](const auto&) { return 0.0; });
    const auto pieces =
        piecesOf(Caster{mesh}, {.origin = {0.3, 0.6, -1.0}, .direction = {0, 0, 1}});
    EXPECT_GT(pieces.size(), 65535U);
    EXPECT_NEAR(sumOf(pieces), kCubes, 1e-11 * kCubes);
    for (std::size_t k = 1; k < pieces.size(); ++k) ASSERT_TRUE(pieces[k].joined);
}

TEST(PathLength, PiecesFollowTheFacesWhereDistancesTie) {
    // Three pieces of length 0 at one place, and the two around them, in the worst order.
    const auto piece = [](double front, double back, int enter, int leave) {
        Piece made;
        made.front = {.distance = front, .f = 0, .g = 0, .face = {enter, 0, 0}};
        made.back = {.distance = back, .f = 0, .g = 0, .face = {leave, 0, 0}};
        return made;
    };
    std::vector<Piece> pieces{piece(1, 1, 3, 4), piece(1, 2, 4, 5), piece(1, 1, 1, 2),
                              piece(0, 1, 0, 1), piece(1, 1, 2, 3)};
    order(pieces);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(pieces[std::size_t(i)].front.face[0], i);
    // The same where the run begins with them.
    pieces = {piece(1, 1, 3, 4), piece(1, 2, 4, 5), piece(1, 1, 1, 2), piece(1, 1, 2, 3)};
    order(pieces);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(pieces[std::size_t(i)].front.face[0], i + 1);
    EXPECT_FALSE(pieces[0].joined);
    EXPECT_TRUE(pieces[1].joined && pieces[2].joined && pieces[3].joined);
}

}  // namespace
}  // namespace volcast::reference
