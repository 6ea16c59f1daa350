#include "renderer/scene/ray_models.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace volcast::scene {
namespace {

constexpr std::array kNoChoice{IntegratorRow{Integrator::kExact, "exact", ""}};

constexpr std::array kVolumeIntegrators{
    IntegratorRow{Integrator::kAverage, "average", "segment/average.glsl"},
    IntegratorRow{Integrator::kLinearOpacity, "linear_opacity", "segment/linear_opacity.glsl"},
    IntegratorRow{Integrator::kPsiTable, "psi_table", "segment/psi_table.glsl"},
    IntegratorRow{Integrator::kPsi, "psi", "segment/psi.glsl"},
    IntegratorRow{Integrator::kPreintegrated, "preintegrated", "segment/preintegrated.glsl"},
    IntegratorRow{Integrator::kExact, "exact", "segment/exact.glsl"}};

constexpr std::array kLineIntegrators{
    IntegratorRow{Integrator::kFront, "front", "segment/line_front.glsl"},
    IntegratorRow{Integrator::kEnds, "ends", "segment/line_ends.glsl"},
    IntegratorRow{Integrator::kExact, "exact", "segment/line_exact.glsl"}};

constexpr std::array kExtremeIntegrators{
    IntegratorRow{Integrator::kEnds, "ends", "segment/largest_ends.glsl"},
    IntegratorRow{Integrator::kExact, "exact", "segment/largest_exact.glsl"}};

constexpr std::array kVolumeOfVoxels{
    IntegratorRow{Integrator::kAverage, "average", "segment/average.glsl"},
    IntegratorRow{Integrator::kPreintegrated, "preintegrated", "segment/preintegrated.glsl"},
    IntegratorRow{Integrator::kLinearOpacity, "linear_opacity", "segment/linear_opacity.glsl"},
    IntegratorRow{Integrator::kPsi, "psi", "segment/psi.glsl"},
    IntegratorRow{Integrator::kExact, "exact", "segment/exact.glsl"},
    IntegratorRow{Integrator::kAdaptive, "adaptive", "segment/average.glsl"}};

constexpr std::array kLinesOfVoxels{
    IntegratorRow{Integrator::kFront, "front", "segment/line_front.glsl"},
    IntegratorRow{Integrator::kEnds, "ends", "segment/line_ends.glsl"},
    IntegratorRow{Integrator::kExact, "exact", "segment/line_exact.glsl"},
    IntegratorRow{Integrator::kAdaptive, "adaptive", "segment/line_front.glsl"}};

// name, chunk; opaque, combine, secondField, onMeshes, onVolumes; integrators of meshes and of
// voxels
constexpr std::array kRayModels{
    RayModelRow{RayModel::kSurface, "surface", "", true, Combine::kNearest, false, true, false,
                kNoChoice, kNoChoice},
    RayModelRow{RayModel::kWireframe, "wireframe", "", true, Combine::kNearest, false, true, false,
                kNoChoice, kNoChoice},
    RayModelRow{RayModel::kMip, "mip", "model/mip.glsl", false, Combine::kMax, false, true, true,
                kNoChoice, kNoChoice},
    RayModelRow{RayModel::kMinip, "minip", "model/minip.glsl", false, Combine::kMin, false, true,
                true, kNoChoice, kNoChoice},
    RayModelRow{RayModel::kMipColour, "mip_colour", "model/mip_colour.glsl", false, Combine::kMax,
                false, true, true, kExtremeIntegrators, kExtremeIntegrators},
    RayModelRow{RayModel::kXray, "xray", "model/xray.glsl", false, Combine::kSum, true, true, true,
                kLineIntegrators, kLinesOfVoxels},
    RayModelRow{RayModel::kSplat, "splat", "model/splat.glsl", false, Combine::kSum, false, true,
                true, kLineIntegrators, kLinesOfVoxels},
    RayModelRow{RayModel::kIsosurface, "isosurface", "model/isosurface.glsl", true,
                Combine::kNearest, true, true, true, kNoChoice, kNoChoice},
    RayModelRow{RayModel::kVolume, "volume", "model/volume.glsl", false, Combine::kUnder, true,
                true, true, kVolumeIntegrators, kVolumeOfVoxels},
    RayModelRow{RayModel::kCrossSections, "cross_sections", "", true, Combine::kNearest, false,
                false, true, kNoChoice, kNoChoice}};

struct EvaluatorName {
    MeshEvaluator evaluator;
    std::string_view name;
};
constexpr std::array kEvaluators{
    EvaluatorName{MeshEvaluator::kAuto, "auto"}, EvaluatorName{MeshEvaluator::kWalk, "walk"},
    EvaluatorName{MeshEvaluator::kProjection, "projection"},
    EvaluatorName{MeshEvaluator::kProjectionFaces, "projection_faces"}};

constexpr std::array<std::string_view, 3> kSamplings{"nearest", "trilinear", "tricubic"};
constexpr std::array<std::string_view, 4> kVoxelEvaluators{"auto", "march", "slices",
                                                           "slice_instances"};

constexpr std::array kAllIntegrators{std::span<const IntegratorRow>{kVolumeIntegrators},
                                     std::span<const IntegratorRow>{kLineIntegrators},
                                     std::span<const IntegratorRow>{kVolumeOfVoxels}};

}  // namespace

std::span<const RayModelRow> rayModels() {
    return kRayModels;
}

const RayModelRow& row(RayModel model) {
    const RayModelRow& found = kRayModels.at(static_cast<std::size_t>(model));
    assert(found.model == model);
    return found;
}

std::string_view name(RayModel model) {
    return row(model).name;
}

std::string_view name(Integrator integrator) {
    for (const auto& rows : kAllIntegrators) {
        const auto found = std::ranges::find(rows, integrator, &IntegratorRow::integrator);
        if (found != rows.end()) return found->name;
    }
    return "auto";
}

std::string_view name(MeshEvaluator evaluator) {
    return std::ranges::find(kEvaluators, evaluator, &EvaluatorName::evaluator)->name;
}

std::string_view name(Sampling sampling) {
    return kSamplings.at(static_cast<std::size_t>(sampling));
}

std::string_view name(VoxelEvaluator evaluator) {
    return kVoxelEvaluators.at(static_cast<std::size_t>(evaluator));
}

std::optional<RayModel> rayModelNamed(std::string_view name) {
    const auto found = std::ranges::find(kRayModels, name, &RayModelRow::name);
    if (found == kRayModels.end()) return std::nullopt;
    return found->model;
}

std::optional<Integrator> integratorNamed(std::string_view name) {
    if (name == "auto") return Integrator::kAuto;
    for (const auto& rows : kAllIntegrators) {
        const auto found = std::ranges::find(rows, name, &IntegratorRow::name);
        if (found != rows.end()) return found->integrator;
    }
    return std::nullopt;
}

std::optional<MeshEvaluator> evaluatorNamed(std::string_view name) {
    const auto found = std::ranges::find(kEvaluators, name, &EvaluatorName::name);
    if (found == kEvaluators.end()) return std::nullopt;
    return found->evaluator;
}

std::optional<Sampling> samplingNamed(std::string_view name) {
    const auto found = std::ranges::find(kSamplings, name);
    if (found == kSamplings.end()) return std::nullopt;
    return static_cast<Sampling>(found - kSamplings.begin());
}

std::optional<VoxelEvaluator> voxelEvaluatorNamed(std::string_view name) {
    const auto found = std::ranges::find(kVoxelEvaluators, name);
    if (found == kVoxelEvaluators.end()) return std::nullopt;
    return static_cast<VoxelEvaluator>(found - kVoxelEvaluators.begin());
}

const IntegratorRow* integratorRow(RayModel model, Integrator integrator, bool mesh) {
    const auto rows = row(model).integratorsOf(mesh);
    const auto found = std::ranges::find(rows, integrator, &IntegratorRow::integrator);
    return found == rows.end() ? nullptr : &*found;
}

bool serves(MeshEvaluator evaluator, RayModel model, Integrator integrator) {
    const RayModelRow& found = row(model);
    switch (evaluator) {
        case MeshEvaluator::kAuto: return true;
        case MeshEvaluator::kWalk:
        case MeshEvaluator::kProjection: return !found.chunk.empty();
        case MeshEvaluator::kProjectionFaces:
            return model == RayModel::kMip || model == RayModel::kMinip ||
                   (model == RayModel::kMipColour &&
                    (integrator == Integrator::kEnds || integrator == Integrator::kAuto));
    }
    return false;
}

std::string allowedIntegrators(RayModel model, bool mesh) {
    std::string names = "auto";
    for (const IntegratorRow& integrator : row(model).integratorsOf(mesh)) {
        names += ", " + std::string{integrator.name};
    }
    return names;
}

std::string allowedModels() {
    std::string names;
    for (const RayModelRow& model : kRayModels) {
        names += (names.empty() ? "" : ", ") + std::string{model.name};
    }
    return names;
}

bool needsField(const Layer& layer) {
    const bool triangles = layer.model == RayModel::kSurface || layer.model == RayModel::kWireframe;
    return !triangles || layer.coloured || layer.interval.has_value();
}

}  // namespace volcast::scene
