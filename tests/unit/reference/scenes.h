#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/data/mesh_builder.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/mesh_phantoms.h"

/// Scenes of one mesh for the reference, and what they look like.
namespace volcast::reference::test {

inline data::Mesh built(data::MeshInput input) {
    auto mesh = data::buildMesh(std::move(input));
    EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
    return mesh.has_value() ? std::move(*mesh) : data::Mesh{};
}

/// A box of cubes with the vertex field "f".
inline data::Mesh boxOf(const support::LatticeDesc& desc, const support::PointFunction& f,
                        data::Association association = data::Association::kVertex) {
    data::MeshInput input = support::latticeMesh(desc);
    support::addField(input, "f", association, f);
    return built(std::move(input));
}

/// A camera whose one pixel looks along a ray: from `eye` through `center`.
inline scene::Camera along(const glm::dvec3& eye, const glm::dvec3& center) {
    const glm::dvec3 view = glm::abs(center - eye);
    return {.eye = eye,
            .center = center,
            .up = view.y > 0.9 * (view.x + view.z) ? glm::dvec3{0, 0, 1} : glm::dvec3{0, 1, 0},
            .projection = scene::Projection::kOrthographic,
            .orthographicHeight = 1e-3};
}

inline scene::Layer layerOf(scene::RayModel model, data::TransferFunction map) {
    scene::Layer layer;
    layer.id = "layer";
    layer.dataset = "mesh";
    layer.field = "f";
    layer.model = model;
    layer.map = std::move(map);
    layer.headlight = false;
    return layer;
}

inline scene::Scene sceneOf(const scene::Camera& camera, std::vector<scene::Layer> layers) {
    scene::Scene scene;
    scene.camera = camera;
    for (std::size_t i = 0; i < layers.size(); ++i) layers[i].id = std::to_string(i);
    scene.layers = std::move(layers);
    return scene;
}

inline Picture drawn(const scene::Scene& scene, const data::Mesh& mesh,
                     const scene::PictureSize& size = {1, 1},
                     const std::vector<glm::ivec2>& pixels = {}) {
    auto picture = draw(scene, {{"mesh", &mesh}}, size, pixels);
    EXPECT_TRUE(picture.has_value()) << picture.error().message;
    if (picture.has_value()) return std::move(*picture);
    return {.size = size, .pixels = {glm::dvec4{-1.0}}, .nearEdge = {0}};
}

/// The one pixel of `layer` from `eye` to `center`.
inline glm::dvec4 seen(const data::Mesh& mesh, const scene::Layer& layer, const glm::dvec3& eye,
                       const glm::dvec3& center) {
    return drawn(sceneOf(along(eye, center), {layer}), mesh).pixels.at(0);
}

/// The same colour everywhere.
inline data::TransferFunction constant(const glm::vec3& colour, float extinction) {
    return {{{.value = 0.0F, .colour = colour, .extinction = extinction}}};
}

/// Colour (v, v, v) and extinction `scale` v over [0, 1].
inline data::TransferFunction ramp(float scale = 1.0F) {
    return {{{.value = 0.0F, .colour = glm::vec3{0.0F}, .extinction = 0.0F},
             {.value = 1.0F, .colour = glm::vec3{1.0F}, .extinction = scale}}};
}

/// What an opacity of constant extinction 1 tells of a length.
inline double lengthOf(double opacity) {
    return -std::log1p(-opacity);
}

}  // namespace volcast::reference::test
