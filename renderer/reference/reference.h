#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/scene/scene.h"

/// The integrals of all ray models in double precision on the CPU: what pictures are measured
/// against. No code or formula is shared with the shaders (README.md says how each differs).
namespace volcast::reference {

/// The pixels that were asked for.
struct Picture {
    scene::PictureSize size{0};
    /// One a requested pixel: linear RGB, premultiplied, and opacity; without the background.
    std::vector<glm::dvec4> pixels;
    /// One a requested pixel. 1: within one pixel of a silhouette, or within 1/2000 pixel of a jump
    /// of the picture, so that an evaluator which rounds may be on the other side of it.
    std::vector<char> nearEdge;
    std::uint64_t piecesVisited = 0;  ///< Cells met by the requested rays, over all layers.
    std::uint64_t rays = 0;           ///< Also those beside the requested ones that find edges.
    double cpuSeconds = 0.0;          ///< What all rays took, on all threads together.
};

class Caster;

/// A mesh or a volume, ready for rays; read by any number of threads. Refers to its data, which
/// must outlive it.
struct Body {
    std::shared_ptr<const Caster> mesh;    ///< A tree of boxes, about 30 bytes a cell; or null.
    const data::Volume* volume = nullptr;  ///< Or null.
};
Body makeBody(const data::Dataset& dataset);

/// By dataset id.
using Bodies = std::map<std::string, Body>;

/// Evaluates `scene` for `pixels`: (column, row) counted from the upper left, through the middle of
/// each; no pixels: all, row by row. What a layer names in `integrator` and `evaluator`, and the
/// scene's `accuracy`, have no influence: everything is integrated exactly.
///
/// `threads` >= 1, the caller's included. `cancelled` may be null; once it is true the call ends
/// with an error within some rays.
///
/// Errors: those of scene::validate(scene); kUnsupported (a model that voxels do not have, markers
/// that have no value for each cell), kNotFound (a dataset that is not among the bodies, a field),
/// kInvalidArgument (size, time step, scale, a pixel outside of the picture), kTimeout
/// (cancelled); `field` as in scene::validate.
Result<Picture> draw(const scene::Scene& scene, const Bodies& bodies, scene::PictureSize size,
                     std::span<const glm::ivec2> pixels = {}, int threads = 1,
                     const std::atomic<bool>* cancelled = nullptr);

/// The same for meshes that are drawn once: makes their bodies first.
Result<Picture> draw(const scene::Scene& scene,
                     const std::map<std::string, const data::Mesh*>& meshes,
                     scene::PictureSize size, std::span<const glm::ivec2> pixels = {},
                     int threads = 1, const std::atomic<bool>* cancelled = nullptr);

}  // namespace volcast::reference
