#include "renderer/scene/camera.h"

#include <cmath>
#include <limits>

#include "gtest/gtest.h"

namespace volcast::scene {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Camera, FrameIsOrthonormalAndLooksAtTheCenter) {
    const Camera camera{.eye = {3, 4, 5}, .center = {1, 0, 2}, .up = {0.1, 1, 0}};
    const CameraFrame axes = frame(camera);
    EXPECT_NEAR(glm::dot(axes.right, axes.up), 0.0, 1e-15);
    EXPECT_NEAR(glm::dot(axes.right, axes.forward), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(axes.up), 1.0, 1e-15);
    EXPECT_NEAR(glm::dot(axes.forward, glm::normalize(glm::dvec3(-2, -4, -3))), 1.0, 1e-15);
    EXPECT_GT(glm::dot(axes.up, camera.up), 0.0);
}

TEST(Camera, XIsToTheRightWhenLookingAlongMinusZ) {
    const CameraFrame axes = frame(Camera{});
    EXPECT_EQ(axes.right, glm::dvec3(1, 0, 0));
    EXPECT_EQ(axes.up, glm::dvec3(0, 1, 0));
}

TEST(Camera, OrbitTurnsByTheRightHandRule) {
    const Camera turned = orbit(Camera{.eye = {0, 0, 3}}, 90.0);
    EXPECT_NEAR(glm::length(turned.eye - glm::dvec3(3, 0, 0)), 0.0, 1e-12);
    Camera around{.eye = {1, 2, 3}, .center = {4, -1, 2}, .up = {1, 2, 0.5}};
    const glm::dvec3 eye = around.eye;
    for (int i = 0; i < 10; ++i) around = orbit(around, 36.0);
    EXPECT_NEAR(glm::length(around.eye - eye), 0.0, 1e-12);
}

TEST(Camera, FitShowsEveryCornerAndWastesLittle) {
    for (const data::Box& box : {data::Box{.min = {0, 0, 0}, .max = {1, 1, 1}},
                                 data::Box{.min = {-1e6, 5, -2}, .max = {-999990, 5.5, 100}},
                                 data::Box{.min = {1e-9, 0, 0}, .max = {2e-9, 1e-9, 1e-9}}}) {
        const Camera camera = fit(box);
        ASSERT_TRUE(validate(camera).has_value());
        const CameraFrame axes = frame(camera);
        const double slope = std::tan(camera.fovyDegrees * 3.14159265358979323846 / 360.0);
        double largest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 offset = glm::dvec3((corner & 1) != 0 ? box.max.x : box.min.x,
                                                 (corner & 2) != 0 ? box.max.y : box.min.y,
                                                 (corner & 4) != 0 ? box.max.z : box.min.z) -
                                      camera.eye;
            const double depth = glm::dot(offset, axes.forward);
            ASSERT_GT(depth, 0.0);
            largest = std::max({largest, std::abs(glm::dot(offset, axes.right)) / depth / slope,
                                std::abs(glm::dot(offset, axes.up)) / depth / slope});
        }
        EXPECT_LT(largest, 1.0);
        EXPECT_GT(largest, 0.85);
    }
    EXPECT_TRUE(validate(fit(data::Box{.min = {7, 7, 7}, .max = {7, 7, 7}})).has_value());
}

TEST(Camera, WhatCannotBeSeenThroughIsRefusedWithItsField) {
    const auto fieldOf = [](const Camera& camera) {
        const Result<void> valid = validate(camera);
        return valid ? std::string{"valid"} : valid.error().field;
    };
    EXPECT_EQ(fieldOf({}), "valid");
    EXPECT_EQ(fieldOf({.eye = {kNan, 0, 0}}), "camera.eye");
    EXPECT_EQ(fieldOf({.eye = {1e300, 0, 0}}), "camera.eye");
    EXPECT_EQ(fieldOf({.center = {0, std::numeric_limits<double>::infinity(), 0}}),
              "camera.center");
    EXPECT_EQ(fieldOf({.eye = {1, 1, 1}, .center = {1, 1, 1}}), "camera.center");
    EXPECT_EQ(fieldOf({.up = {0, 0, 0}}), "camera.up");
    EXPECT_EQ(fieldOf({.up = {0, 0, -5}}), "camera.up");
    EXPECT_EQ(fieldOf({.fovyDegrees = 0}), "camera.fovy_degrees");
    EXPECT_EQ(fieldOf({.fovyDegrees = 180}), "camera.fovy_degrees");
    EXPECT_EQ(fieldOf({.fovyDegrees = kNan}), "camera.fovy_degrees");
    EXPECT_EQ(fieldOf({.projection = Projection::kOrthographic, .orthographicHeight = -1}),
              "camera.orthographic_height");
    EXPECT_EQ(fieldOf({.projection = Projection::kOrthographic, .fovyDegrees = kNan}), "valid");
}

}  // namespace
}  // namespace volcast::scene
