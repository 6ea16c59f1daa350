#pragma once

#include <algorithm>
#include <array>

#include "renderer/scene/scene.h"
#include "volcast/v1/scene.pb.h"

/// Enumerators of scenes beside those of the protocol; read by scene_message.cpp and
/// scene_message_write.cpp alone.
namespace volcast::worker {

/// One enumerator of ours and of the protocol.
template <class Ours, class Theirs>
struct Pair {
    Ours ours;
    Theirs theirs;
};
template <class Ours, class Theirs>
Pair(Ours, Theirs) -> Pair<Ours, Theirs>;

using scene::Integrator;
using scene::MeshEvaluator;
using scene::RayModel;

constexpr std::array kModels{
    Pair{RayModel::kVolume, v1::RAY_MODEL_VOLUME},
    Pair{RayModel::kVolume, v1::RAY_MODEL_UNSPECIFIED},
    Pair{RayModel::kSurface, v1::RAY_MODEL_SURFACE},
    Pair{RayModel::kWireframe, v1::RAY_MODEL_WIREFRAME},
    Pair{RayModel::kMip, v1::RAY_MODEL_MIP},
    Pair{RayModel::kMinip, v1::RAY_MODEL_MINIP},
    Pair{RayModel::kMipColour, v1::RAY_MODEL_MIP_COLOUR},
    Pair{RayModel::kXray, v1::RAY_MODEL_XRAY},
    Pair{RayModel::kSplat, v1::RAY_MODEL_SPLAT},
    Pair{RayModel::kIsosurface, v1::RAY_MODEL_ISOSURFACE},
    Pair{RayModel::kCrossSections, v1::RAY_MODEL_CROSS_SECTIONS},
};

constexpr std::array kIntegrators{
    Pair{Integrator::kAuto, v1::INTEGRATOR_AUTO},
    Pair{Integrator::kAverage, v1::INTEGRATOR_AVERAGE},
    Pair{Integrator::kLinearOpacity, v1::INTEGRATOR_LINEAR_OPACITY},
    Pair{Integrator::kPsiTable, v1::INTEGRATOR_PSI_TABLE},
    Pair{Integrator::kPsi, v1::INTEGRATOR_PSI},
    Pair{Integrator::kPreintegrated, v1::INTEGRATOR_PREINTEGRATED},
    Pair{Integrator::kExact, v1::INTEGRATOR_EXACT},
    Pair{Integrator::kFront, v1::INTEGRATOR_FRONT},
    Pair{Integrator::kEnds, v1::INTEGRATOR_ENDS},
    Pair{Integrator::kAdaptive, v1::INTEGRATOR_ADAPTIVE},
};

constexpr std::array kEvaluators{
    Pair{MeshEvaluator::kAuto, v1::MESH_EVALUATOR_AUTO},
    Pair{MeshEvaluator::kWalk, v1::MESH_EVALUATOR_WALK},
    Pair{MeshEvaluator::kProjection, v1::MESH_EVALUATOR_PROJECTION},
    Pair{MeshEvaluator::kProjectionFaces, v1::MESH_EVALUATOR_PROJECTION_FACES},
};

constexpr std::array kSamplings{
    Pair{scene::Sampling::kTrilinear, v1::SAMPLING_TRILINEAR},
    Pair{scene::Sampling::kNearest, v1::SAMPLING_NEAREST},
    Pair{scene::Sampling::kTricubic, v1::SAMPLING_TRICUBIC},
};

constexpr std::array kVoxelEvaluators{
    Pair{scene::VoxelEvaluator::kAuto, v1::VOXEL_EVALUATOR_AUTO},
    Pair{scene::VoxelEvaluator::kMarch, v1::VOXEL_EVALUATOR_MARCH},
    Pair{scene::VoxelEvaluator::kSlices, v1::VOXEL_EVALUATOR_SLICES},
    Pair{scene::VoxelEvaluator::kSliceInstances, v1::VOXEL_EVALUATOR_SLICE_INSTANCES},
};

constexpr std::array kScales{
    Pair{scene::Scale::Kind::kLinear, v1::Scale::LINEAR},
    Pair{scene::Scale::Kind::kLog, v1::Scale::LOG},
    Pair{scene::Scale::Kind::kPower, v1::Scale::POWER},
};

constexpr std::array kSpacings{
    Pair{scene::Levels::Spacing::kList, v1::Levels::LIST},
    Pair{scene::Levels::Spacing::kLinear, v1::Levels::LINEAR},
    Pair{scene::Levels::Spacing::kLog, v1::Levels::LOG},
    Pair{scene::Levels::Spacing::kPower, v1::Levels::POWER},
};

constexpr std::array kAccuracies{
    Pair{scene::Accuracy::Kind::kAuto, v1::Accuracy::AUTO},
    Pair{scene::Accuracy::Kind::kFastest, v1::Accuracy::FASTEST},
    Pair{scene::Accuracy::Kind::kExact, v1::Accuracy::EXACT},
    Pair{scene::Accuracy::Kind::kErrorBound, v1::Accuracy::ERROR_BOUND},
    Pair{scene::Accuracy::Kind::kTimeBudget, v1::Accuracy::TIME_BUDGET},
};

/// Every enumerator of ours has a row.
template <class Pairs, class Ours>
auto theirsFrom(const Pairs& pairs, Ours ours) {
    return std::ranges::find_if(pairs, [ours](const auto& pair) { return pair.ours == ours; })
        ->theirs;
}

}  // namespace volcast::worker
