#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/plan/evidence.h"
#include "renderer/scene/scene.h"

namespace volcast::plan {

enum class Evaluator {
    kMeshWalk,
    kMeshProjection,       ///< Cells by their front faces.
    kMeshProjectionFaces,  ///< Cells by all their faces.
    kMeshRaster,           ///< Boundary faces as triangles.
    kVolumeMarch,
    kVolumeSlices,          ///< Polygons across the view.
    kVolumeSliceInstances,  ///< The same as instances of one.
    kCrossSections,         ///< Planes through voxels.
};

/// One effect, on or off, and why.
struct Effect {
    std::string name;  ///< Such as "gradient", "re-entry", "empty bricks".
    bool on = false;
    std::string reason;  ///< For a human: "the mesh is convex".
};

/// How one layer is drawn.
struct LayerPlan {
    std::string layer;
    Evaluator evaluator = Evaluator::kMeshWalk;
    scene::Integrator method = scene::Integrator::kExact;  ///< Never kAuto.
    std::string integrator;  ///< As in the frame header: "average", "march", or empty.
    double stepWorld = 0.0;  ///< Voxels: the longest distance between samples, world units.
    std::vector<Effect> effects;
    std::optional<double> predictedMs = {};  ///< Of this layer's draw, where it is known.
    std::optional<double> errorBound = {};   ///< In 1/255, where it was measured.
    bool drawn = true;  ///< False where nothing can be seen (hidden, transparent everywhere).
    /// The layer whose walk draws this one too; empty: its own.
    std::string drawnWith;

    /// State of the effect `name`; effects that the plan does not list are off.
    [[nodiscard]] bool has(const std::string& name) const;
};

/// How a scene is drawn. Anything a plan leaves out costs nothing.
struct FramePlan {
    std::string id;                 ///< Equal for equal plans: a short hash of all below.
    std::vector<LayerPlan> layers;  ///< In the scene's order.
};

/// Most samples on one ray of the volume march. llvmpipe ends all loops of a pixel after 65,535
/// iterations without a word; what is left is for passing over bricks.
inline constexpr int kMaxRaySamples = 60'000;

/// The same where pieces are split, and their parts: both are loops.
inline constexpr int kMaxRayPieces = 30'000;

/// Rounds that an adaptive march may need for one of the layer's steps: 4 as short as they get, and
/// as many that are tried and halved.
inline constexpr int kMaxRoundsAStep = 8;

/// How far tricubic values may leave the range of the voxels they come from, as a part of it:
/// derived in shaders/volume/march_ray.glsl.
inline constexpr float kTricubicOvershoot = 0.48F;

/// The same where voxels are bricks, whose search takes rounds, too. Ranges are asked for every 32
/// grid intervals along the axis that a ray advances most on, twice where the model foresees them,
/// each by at most 8 searches of at most 8 levels and a round more: 2 times 128 times 72 rounds for
/// kMaxSkippedSide, beyond which none are asked for. Rays enter at most 3 times 128 bricks beside.
inline constexpr int kMaxBrickedRaySamples = 36'000;
inline constexpr int kMaxSkippedSide = 4096;
/// The same of volumes with longer sides, whose rays enter at most 3 times 1024 bricks, each by a
/// search of at most 11 rounds.
inline constexpr int kMaxWideBrickedRaySamples = 30'000;
/// The same where pieces are split, and their parts: nothing is foreseen there, so that ranges take
/// 128 times 72 rounds and 3 times 128 bricks 9 each; 14'000 is less than half of what the longer
/// sides leave.
inline constexpr int kMaxBrickedRayPieces = 24'000;
inline constexpr int kMaxWideBrickedRayPieces = 14'000;

/// What all loops of a ray have room for.
struct RayLimits {
    int samples = kMaxRaySamples;
    int pieces = kMaxRayPieces;  ///< And as many parts.
};

/// Of voxels as a whole, or of bricks of a volume with so many coarser levels.
RayLimits rayLimits(bool bricked, int coarserLevels) noexcept;

/// What the machine has to offer.
struct Limits {
    /// Of GPU memory, for all voxels of a scene: where its layers take more together, those that
    /// can are drawn from bricks, which share it.
    std::uint64_t volumeBytes = std::uint64_t{1} << 30;
    std::uint64_t pictureBytes = std::uint64_t{16} << 20;  ///< Of bricks that one picture loads.
};

/// `scene` must be valid against `summaries`. `evidence` decides where the scene bounds error or
/// time.
FramePlan plan(const scene::Scene& scene, const scene::Summaries& summaries,
               const SceneEvidence& evidence = {}, const Limits& limits = {});

}  // namespace volcast::plan
