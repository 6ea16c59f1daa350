#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"
#include "renderer/scene/camera.h"

namespace volcast::scene {

/// What a ray gathers. Each is one GLSL chunk and one row of renderer/shading/ray_models.h.
enum class RayModel {
    kSurface,  ///< Nearest boundary point of a mesh.
    kMip,      ///< Colour of the largest value on the ray (voxels: MAX).
    kVolume,   ///< Emission and absorption (voxels: ON).
};

/// How `volume` integrates one cell.
enum class Integrator {
    kAuto,     ///< Whatever the plan finds best.
    kAverage,  ///< Mean of both ends; exact where the field is constant in a cell.
};

/// How voxels are read between grid points.
enum class Sampling { kNearest, kTrilinear };

/// One data model drawn with one ray model.
struct Layer {
    std::string id;       ///< Unique in its scene; names the layer in diffs and errors.
    std::string dataset;  ///< Catalogue id.
    std::string field;    ///< Name of a mesh field or voxel channel; empty: the first.
    int timeStep = 0;
    RayModel model = RayModel::kVolume;
    data::TransferFunction map;
    bool visible = true;
    // surface
    bool coloured = false;          ///< C(f) instead of `surfaceColour`.
    glm::vec3 surfaceColour{0.8F};  ///< Linear RGB.
    bool headlight = true;          ///< c |n.w| instead of c.
    // volume of a mesh
    Integrator integrator = Integrator::kAuto;
    // voxels
    double stepWorld = 0.0;  ///< World units; 0: half the smallest spacing.
    Sampling sampling = Sampling::kTrilinear;

    friend bool operator==(const Layer&, const Layer&) = default;
};

/// All that decides a picture but its size. Host-side truth: GPU state is a cache of it.
struct Scene {
    static constexpr std::size_t kMaxLayers = 16;

    Camera camera;
    std::vector<Layer> layers;
    glm::vec4 background{0.0F, 0.0F, 0.0F, 1.0F};  ///< Linear RGB (not premultiplied) and opacity.

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Pixels of a picture, width and height.
using PictureSize = glm::ivec2;
inline constexpr int kMaxPictureSide = 8192;

/// What the renderer may ask about the datasets of a scene.
using Summaries = std::map<std::string, data::DatasetSummary>;

}  // namespace volcast::scene
