// Cross-sections of a linear field, whose values on a plane are known.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

const support::GridPlace kPlace{.size = {11, 9, 21},
                                .spacing = {1.0, 1.5, 0.5},
                                .origin = {100, -50, 7},
                                .direction = support::turn({1, 1, 2}, 50.0)};

double linear(const glm::dvec3& p) {
    return 3.0 * p.x + 5.0 * p.y - p.z + 20.0;
}

class CrossSections : public support::RenderTest {
protected:
    CrossSections() {
        renderer_->addDataset("volume", support::volumeOf(kPlace, linear));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.model = scene::RayModel::kCrossSections;
        // Red is the value over 100.
        layer.map = {{{.value = 0.0F, .colour = {0, 0, 1}, .extinction = 0},
                      {.value = 100.0F, .colour = {1, 0, 1}, .extinction = 0}}};
        scene_.layers = {layer};
        const glm::dvec3 extent = kPlace.spacing * glm::dvec3(kPlace.size - 1);
        center_ = kPlace.origin + kPlace.direction * (0.5 * extent);
        scene_.camera = {.eye = center_ + glm::dvec3(12, 17, 14), .center = center_};
    }

    /// The value that the middle of the picture shows, or -1.
    double middle() {
        const auto picture = draw(scene_, {33, 33});
        const glm::vec4 pixel = picture.at(16, 16);
        return pixel.a > 0.0F ? 100.0 * pixel.r : -1.0;
    }

    void showOnly(int axis) {
        scene_.layers[0].crossSections.shown = glm::bvec3(axis == 0, axis == 1, axis == 2);
    }

    /// Where the middle ray meets the plane across `axis` through `at`, both in grid coordinates.
    [[nodiscard]] glm::dvec3 meets(int axis, double at) const {
        const auto grid = [](const glm::dvec3& world) {
            return (glm::transpose(kPlace.direction) * (world - kPlace.origin)) / kPlace.spacing;
        };
        const glm::dvec3 from = grid(scene_.camera.eye), to = grid(scene_.camera.center);
        return from + (to - from) * ((at - from[axis]) / (to[axis] - from[axis]));
    }

    scene::Scene scene_;
    glm::dvec3 center_{0.0};
};

TEST_F(CrossSections, ShowTheFieldWhereARayMeetsThem) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double share : {0.4, 0.5, 0.6}) {
            const glm::dvec3 at = share * glm::dvec3(kPlace.size - 1);
            scene_.layers[0].crossSections.point =
                kPlace.origin + kPlace.direction * (kPlace.spacing * at);
            showOnly(axis);
            EXPECT_NEAR(middle(), linear(meets(axis, at[axis])), 1e-3) << axis << ' ' << share;
        }
    }
}

TEST_F(CrossSections, MeetInTheMiddleUnlessAPointIsGiven) {
    EXPECT_NEAR(middle(), linear(0.5 * glm::dvec3(kPlace.size - 1)), 1e-3);
}

TEST_F(CrossSections, TheNearestThatShowsWins) {
    // Moved towards the eye along the grid's axes, the planes are met one after the other.
    const glm::dvec3 at = glm::dvec3(kPlace.size - 1) * glm::dvec3(0.6, 0.6, 0.6);
    scene_.layers[0].crossSections.point = kPlace.origin + kPlace.direction * (kPlace.spacing * at);
    std::vector<std::pair<double, double>> met;  // Distance and value.
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 point = meets(axis, at[axis]);
        const glm::dvec3 world = kPlace.origin + kPlace.direction * (kPlace.spacing * point);
        const bool inside = glm::all(glm::greaterThan(point, glm::dvec3(0.0))) &&
                            glm::all(glm::lessThan(point, glm::dvec3(kPlace.size - 1)));
        if (inside) met.emplace_back(glm::length(world - scene_.camera.eye), linear(point));
    }
    ASSERT_GE(met.size(), 2U);
    std::ranges::sort(met);
    EXPECT_NEAR(middle(), met[0].second, 1e-3);
    // What an interval leaves out is looked through.
    const auto second = static_cast<float>(met[1].second);
    ASSERT_GT(std::abs(met[0].second - met[1].second), 0.5);
    scene_.layers[0].interval = data::Range{.min = second - 0.25F, .max = second + 0.25F};
    EXPECT_NEAR(middle(), second, 1e-3);
}

TEST_F(CrossSections, AreCutByClipPlanesAndHiddenAltogether) {
    scene_.clipPlanes = {{.normal = {1, 0, 0}, .offset = 1000.0}};
    EXPECT_EQ(middle(), -1.0);
    scene_.clipPlanes.clear();
    scene_.layers[0].crossSections.shown = glm::bvec3(false);
    const auto picture = draw(scene_, {8, 8});
    EXPECT_FALSE(picture.info.plan.layers[0].drawn);
    for (const float value : picture.linear) EXPECT_EQ(value, 0.0F);
}

TEST_F(CrossSections, EndTheRaysOfOtherLayers) {
    scene::Layer glow = scene_.layers[0];
    glow.id = "glow";
    glow.model = scene::RayModel::kMip;
    scene_.layers.push_back(glow);
    showOnly(2);
    scene_.layers[1].crossSections = scene_.layers[0].crossSections;
    const auto both = draw(scene_, {33, 33});
    scene_.layers.erase(scene_.layers.begin());
    const auto alone = draw(scene_, {33, 33});
    // A ray that ends half-way meets a smaller maximum, over the plane's own colour.
    EXPECT_LT(both.at(16, 16).r, alone.at(16, 16).r + 1e-6F);
}

}  // namespace
}  // namespace volcast
