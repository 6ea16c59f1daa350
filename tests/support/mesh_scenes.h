#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "renderer/data/mesh_builder.h"
#include "renderer/scene/scene.h"
#include "tests/support/mesh_phantoms.h"
#include "tests/support/render_test.h"

namespace volcast::support {

/// White with one extinction everywhere: the opacity of a ray tells its length.
inline data::TransferFunction fog(float extinction) {
    return {{{.value = 0.0F, .colour = glm::vec3{1.0F}, .extinction = extinction}}};
}

/// Grey from 0 at `low` to 1 at `high`: the colour of a mip tells the value.
inline data::TransferFunction ruler(float low, float high, float extinction = 1.0F) {
    return {{{.value = low, .colour = glm::vec3{0.0F}, .extinction = extinction},
             {.value = high, .colour = glm::vec3{1.0F}, .extinction = extinction}}};
}

/// The world length that an opacity of `extinction` means.
inline double lengthOf(float opacity, float extinction) {
    return -std::log1p(-static_cast<double>(opacity)) / static_cast<double>(extinction);
}

/// A test that draws one mesh at a time.
class MeshTest : public RenderTest {
protected:
    /// Makes `input` the mesh to draw; gives it a field "f" of zeros at vertices if it has none.
    const data::Mesh& use(data::MeshInput input) {
        if (input.fields.empty()) {
            addField(input, "f", data::Association::kVertex, [](const auto&) { return 0.0; });
        }
        mesh_ = must(data::buildMesh(std::move(input)));
        renderer_->addDataset("mesh", mesh_);
        return mesh_;
    }

    static scene::Scene sceneOf(const scene::Camera& camera, scene::RayModel model,
                                const data::TransferFunction& map, const std::string& field = "") {
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "mesh";
        layer.field = field;
        layer.model = model;
        layer.map = map;
        scene::Scene scene;
        scene.camera = camera;
        scene.layers.push_back(layer);
        return scene;
    }

    data::Mesh mesh_;
};

inline scene::Camera orthographic(const glm::dvec3& eye, const glm::dvec3& center, double height,
                                  const glm::dvec3& up = {0, 1, 0}) {
    return {.eye = eye,
            .center = center,
            .up = up,
            .projection = scene::Projection::kOrthographic,
            .orthographicHeight = height};
}

inline scene::Camera perspective(const glm::dvec3& eye, const glm::dvec3& center,
                                 double fovyDegrees = 40.0, const glm::dvec3& up = {0, 1, 0}) {
    return {.eye = eye, .center = center, .up = up, .fovyDegrees = fovyDegrees};
}

/// Length of a ray in the box [low, high], from its origin on.
inline double lengthInBox(const glm::dvec3& origin, const glm::dvec3& direction,
                          const glm::dvec3& low, const glm::dvec3& high) {
    double front = 0.0;
    double back = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - origin[axis]) / direction[axis];
        const double b = (high[axis] - origin[axis]) / direction[axis];
        if (direction[axis] == 0.0) {
            if (origin[axis] < low[axis] || origin[axis] > high[axis]) return 0.0;
            continue;
        }
        front = std::max(front, std::min(a, b));
        back = std::min(back, std::max(a, b));
    }
    return std::max(back - front, 0.0);
}

}  // namespace volcast::support
