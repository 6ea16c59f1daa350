#pragma once

#include <list>
#include <string>

#include "renderer/accuracy/measurement.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/render.h"

namespace volcast::accuracy {

/// Measures what drawing with one candidate is worth and costs, against the reference. What the
/// reference finds is kept for the other candidates of the same picture.
///
/// All calls on the renderer's thread.
class Meter {
public:
    explicit Meter(scene::Renderer& renderer) noexcept : renderer_{renderer} {}

    /// Draws job.frames + 1 pictures in a view of its own, and one more where steps are counted.
    /// The frames that are timed turn the camera by a thousandth of a degree each, so that none is
    /// a repetition.
    ///
    /// Errors: as scene::Renderer::render and reference::draw; kInvalidArgument for a layer that
    /// the scene does not have; kUnsupported for voxel volumes.
    Result<Measurement> measure(const Job& job);

    /// The mean number of cells that a ray meets, from at most `pixels` rays. Errors: as above.
    Result<double> cellsPerRay(const scene::Scene& scene, scene::PictureSize size,
                               std::uint64_t pixels);

    /// To be called before the renderer replaces or removes the dataset.
    void forget(const std::string& dataset);

private:
    /// A picture of the reference, and all that it depends on.
    struct Truth {
        scene::Scene scene;  ///< Without what has no influence on the truth.
        scene::PictureSize size{0};
        std::vector<glm::ivec2> pixels;
        reference::Picture picture;
    };
    Result<const Truth*> truthOf(const scene::Scene& scene, scene::PictureSize size,
                                 std::uint64_t pixels);
    Result<void> time(const Job& job, const scene::Scene& scene, Measurement& measured);
    /// `drawn`: the layer in whose draw the candidate's is.
    Result<void> count(const Job& job, const scene::Scene& scene, const std::string& drawn,
                       Measurement& measured);

    scene::Renderer& renderer_;
    reference::Casters casters_;
    std::list<Truth> truths_;  ///< The last used first.
};

}  // namespace volcast::accuracy
