#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/scene/scene.h"

namespace volcast::scene {

/// One way to integrate a ray's share of a cell, and the chunk that fills the slot `segment`.
struct IntegratorRow {
    Integrator integrator;
    std::string_view name;   ///< As in plans, in the protocol and on the command line.
    std::string_view chunk;  ///< Empty: the model needs none.
};

/// How what a ray gathered in two pieces becomes one; each row is a state of blending too
/// (renderer/mesh/README.md has the table).
enum class Combine {
    kNearest,  ///< The nearer one, by depth.
    kMax,      ///< The larger, each channel by itself.
    kMin,      ///< The smaller, each channel by itself.
    kSum,
    kUnder,  ///< The nearer over the farther, premultiplied: pieces must come in order.
};

/// One ray model: its names, its chunk, and what it needs of a program. The only place that lists
/// them; adding one is described in shaders/README.md.
struct RayModelRow {
    RayModel model;
    std::string_view name;  ///< As in plans, in the protocol and on the command line.
    std::string_view
        chunk;    ///< Fills the slot `model`; empty: not gathered along rays: faces, planes.
    bool opaque;  ///< Ends the rays of layers that are not.
    Combine combine;
    bool secondField;  ///< A second field has a meaning.
    bool onMeshes;
    bool onVolumes;
    std::span<const IntegratorRow> integrators;  ///< From cheap to exact; the last is exact.
    /// The same on voxels, where pieces lie between samples: the first takes each sample as a
    /// constant piece, the last splits pieces and sets its own steps.
    std::span<const IntegratorRow> voxelIntegrators;

    [[nodiscard]] std::span<const IntegratorRow> integratorsOf(bool mesh) const {
        return mesh ? integrators : voxelIntegrators;
    }
};

/// All ray models, in the order of RayModel.
std::span<const RayModelRow> rayModels();
const RayModelRow& row(RayModel model);

/// "surface", "mip_colour", ...
std::string_view name(RayModel model);
/// "auto", "average", "psi_table", ...
std::string_view name(Integrator integrator);
/// "auto", "walk", "projection", "projection_faces".
std::string_view name(MeshEvaluator evaluator);

/// "nearest", "trilinear", "tricubic".
std::string_view name(Sampling sampling);
/// "auto", "march", "slices", "slice_instances".
std::string_view name(VoxelEvaluator evaluator);

/// Nothing for a name that is not known.
std::optional<RayModel> rayModelNamed(std::string_view name);
std::optional<Integrator> integratorNamed(std::string_view name);
std::optional<MeshEvaluator> evaluatorNamed(std::string_view name);
std::optional<Sampling> samplingNamed(std::string_view name);
std::optional<VoxelEvaluator> voxelEvaluatorNamed(std::string_view name);

/// The row of `integrator` among those that serve `model` on meshes or on voxels, or null.
const IntegratorRow* integratorRow(RayModel model, Integrator integrator, bool mesh = true);
/// Whether `evaluator` can draw `model` with `integrator`; kAuto always can.
bool serves(MeshEvaluator evaluator, RayModel model, Integrator integrator);

/// "average, linear_opacity, ...": for messages.
std::string allowedIntegrators(RayModel model, bool mesh = true);
std::string allowedModels();

/// The field and map that a ray of `layer` reads: a surface in one colour needs neither.
bool needsField(const Layer& layer);

}  // namespace volcast::scene
