#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "renderer/plan/plan.h"
#include "renderer/scene/scene.h"

namespace volcast::accuracy {

/// How far pixels are from the truth, in linear light, premultiplied, over red, green, blue and
/// opacity; 1 is the display's white. Values above it count as they are.
struct Errors {
    double max = 0.0;  ///< Of any channel of any pixel.
    double rms = 0.0;  ///< Over all channels of all pixels.
    double share255 =
        0.0;  ///< Of pixels, in [0, 1], one of whose channels is off by more than 1/255.
    double share65535 = 0.0;   ///< The same by more than 1/65535.
    std::uint64_t pixels = 0;  ///< That were compared.
};

/// One way to draw one layer.
struct Candidate {
    std::size_t layer = 0;  ///< Index in the scene.
    scene::Integrator integrator = scene::Integrator::kAuto;
    scene::MeshEvaluator evaluator = scene::MeshEvaluator::kAuto;
    friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// What is to be found out.
enum class Aim {
    kCandidate,  ///< What one way to draw one layer is worth, and what it costs.
    kPicture,    ///< Where the picture is off, drawn as the scene asks.
    kEstimates,  ///< What plans with bounds go by; little is drawn for it.
    kTime,       ///< What the picture takes, drawn as the scene asks; `frames` at least 1.
};

/// Pixels whose column and row are multiples of `step`, but for those of 2 * step where it
/// `refines` a coarser grid; in rows from `firstRow` to before `endRow`.
struct Grid {
    int step = 1;
    bool refines = false;
    int firstRow = 0, endRow = 0;
    friend bool operator==(const Grid&, const Grid&) = default;
};

/// What is to be measured.
struct Job {
    scene::Scene scene;
    scene::PictureSize size{512};
    Aim aim = Aim::kCandidate;
    Grid grid = {};            ///< To compare, where the aim is the picture.
    Candidate candidate = {};  ///< Where it is the aim, as is what follows; frames of times, too.
    int frames = 0;            ///< Draws to time, after one that warms up; 0: errors alone.
    std::uint64_t pixels = 0;  ///< To compare, spread over the picture; 0: all.
    bool countsSteps = false;  ///< In one more frame, which is not timed.
    friend bool operator==(const Job&, const Job&) = default;
};

/// What the reference took: CPU time of all its threads, in double precision.
struct ReferenceEffort {
    std::uint64_t rays = 0;  ///< Of compared pixels, and beside them to find edges.
    double raySeconds = 0.0, treeSeconds = 0.0;
};

/// What drawing a scene with one candidate is worth, and what it costs.
struct Measurement {
    Errors all;
    Errors inner;  ///< Without pixels near a silhouette, where rounding may decide what is hit.
    double medianMs = 0.0, minMs = 0.0, maxMs = 0.0;  ///< Of one draw at full size.
    int frames = 0;
    double cellsPerRay = 0.0;  ///< Mean over the compared pixels; what the reference's rays meet.
    std::uint64_t walkSteps = 0;     ///< Of all rays of one picture; see mesh::WalkState::steps().
    std::uint64_t cellsDrawn = 0;    ///< In one picture, by the projection.
    ReferenceEffort reference = {};  ///< Zeros where its picture, or its tree, was known before.
    plan::Evaluator evaluator = plan::Evaluator::kMeshWalk;  ///< What drew the layer.
    std::string integrator;                                  ///< As in plans.
    /// Of the picture: by pixel of its grid, row by row, how far the channel is off that is off
    /// most.
    std::vector<float> off = {};
    plan::SceneEvidence estimates = {};
};

/// All ways that the registry has for the visible layers of `scene`, in its order: integrators from
/// cheap to exact, and each evaluator that serves them. Layers drawn as triangles have one, and so
/// has each integrator of voxels. `volumes`: ids of datasets that are voxels.
std::vector<Candidate> candidates(const scene::Scene& scene,
                                  const std::set<std::string>& volumes = {});

/// `scene` with one layer drawn as `candidate` says, and exactly wherever no integrator is named.
scene::Scene withCandidate(const scene::Scene& scene, const Candidate& candidate);

/// (column, row), row by row.
std::vector<glm::ivec2> gridPixels(scene::PictureSize size, const Grid& grid);

/// At most `count` different pixels (column, row), spread evenly and the same each time; 0 or more
/// than there are: all, row by row.
std::vector<glm::ivec2> samplePixels(scene::PictureSize size, std::uint64_t count);

}  // namespace volcast::accuracy
