#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/plan/plan.h"
#include "renderer/scene/layer_fields.h"

namespace volcast::plan {

/// What the rays of one layer meet.
struct Matter {
    const scene::Layer& layer;
    const data::DatasetSummary& summary;
    const data::FieldSummary* field;        // The one that rays carry.
    std::optional<scene::FieldUse> second;  // g, where it has values of its own.
    scene::LayerMaps maps;
    data::Range extinction;  // Of the field's values; volume and xray.
    double diagonal;         // Of the bounds, world units.
};

/// The matter of `layer`; all must live longer than it.
Matter matterOf(const scene::Layer& layer, const data::DatasetSummary& summary);

/// What all visible layers of voxels take as wholes; what two of them share counts once.
struct Residency {
    std::size_t wholes = 0;
    std::uint64_t bytes = 0;
};
Residency residencyOf(const scene::Scene& scene, const scene::Summaries& summaries);

/// Steps on a ray that all loops of a pixel have room for.
int mostSteps(scene::Integrator method, const RayLimits& limits);

/// Whether values change within a cell.
bool varies(const data::FieldSummary* field);

/// Whether the map's extinction has a meaning.
bool absorbs(scene::RayModel model);

/// Smallest and largest extinction that the map gives to values in `range`.
data::Range extinctionOver(const data::TransferFunction& map, data::Range range);

/// Four digits, for reasons.
std::string number(double value);

void add(LayerPlan& plan, const char* name, bool on, std::string reason);

// What meshes and voxels have in common.
void planEarlyStop(LayerPlan& plan, const Matter& matter);
void planHeadlight(LayerPlan& plan, const scene::Layer& isosurface);

/// What is known of the method chosen.
void planEvidence(LayerPlan& plan, std::span<const Evidence> evidence);

/// The step that a layer names, world units; 0: none.
double askedStep(const Matter& matter, const scene::Camera& camera);
/// A user's code in the place of the map, on any data; and all else of it on a mesh.
void planCode(LayerPlan& plan, const Matter& matter);
void planMeshCode(LayerPlan& plan, const Matter& matter, const scene::Camera& camera);

/// Rays through a mesh.
void planMeshRays(LayerPlan& plan, const Matter& matter, const scene::Scene& scene,
                  std::span<const Evidence> evidence);
/// Boundary faces.
void planSurface(LayerPlan& plan, const Matter& matter);
/// Rays through voxels.
void planVoxels(LayerPlan& plan, const Matter& matter, const scene::Scene& scene,
                std::span<const Evidence> evidence);
/// Whether voxels are on the GPU as a whole or as bricks; after the two around this one.
void planResidency(LayerPlan& plan, const Matter& matter, const Limits& limits,
                   const Residency& all);
/// How their pieces are integrated.
void planVoxelMethod(LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                     std::span<const Evidence> evidence);
/// Planes through voxels.
void planCrossSections(LayerPlan& plan, const Matter& matter);

}  // namespace volcast::plan
