#pragma once

#include <span>

#include <glm/glm.hpp>

#include "renderer/data/dataset.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/scene.h"
#include "renderer/shading/shared.h"

namespace volcast::scene {

using shading::shared::LayerBlock;

/// Depths along the view direction that hold all data of a scene, world units.
struct DepthRange {
    double nearest = 0.0;   ///< Where rays start: 0 or more.
    double farthest = 1.0;  ///< More than `nearest`.
    friend bool operator==(const DepthRange&, const DepthRange&) = default;
};

/// Of the boxes in front of the eye's plane; {0, 1} where there are none.
DepthRange depthRange(const Camera& camera, std::span<const data::Box> boxes);

/// Half of what the picture spans to the right and upwards: at depth 1 (perspective) or anywhere
/// (orthographic), world units.
glm::dvec2 halfExtent(const Camera& camera, PictureSize size);

/// Where cross-sections meet, in grid coordinates: within the grid.
glm::dvec3 meetingPoint(const CrossSections& planes, const data::Volume& volume);

/// The block of one layer; see shaders/shared/layer_block.glsl. Computed in double relative to the
/// dataset's own origin, so that neither is rounded far away from the world's origin.
LayerBlock layerBlock(PictureSize size, const DepthRange& depths, const Scene& scene,
                      const Layer& layer, const data::Dataset& dataset,
                      const data::DatasetSummary& summary, double stepWorld);

}  // namespace volcast::scene
