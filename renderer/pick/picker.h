#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/reference/evaluate.h"
#include "renderer/scene/picked.h"
#include "renderer/scene/scene.h"

namespace volcast::pick {

/// Says what pixels show, ray by ray in double precision on the CPU.
///
/// Keeps what rays need of datasets and of the last scene, so that the next pixel costs one ray
/// alone. Not thread-safe.
class Picker {
public:
    /// The dataset of an id, or null; good until forget().
    using Datasets = std::function<const data::Dataset*(const std::string&)>;

    /// The place that `pixel` (from the upper left) shows most of: among layers the one with the
    /// largest share of the pixel's light, in it the sample that won (extremes), the strongest
    /// contribution (volume, xray, splat, mip_colour), or the point that was hit (opaque layers).
    /// Nothing where nothing was hit. Layers drawn by a user's shader are looked through.
    ///
    /// Errors: as scene::validate; kInvalidArgument for a pixel outside of the picture.
    Result<std::optional<scene::Picked>> pick(const scene::Scene& scene, scene::PictureSize size,
                                              glm::ivec2 pixel, const Datasets& datasets);

    /// The dataset was replaced or removed.
    void forget(const std::string& dataset);

private:
    struct Known {
        const data::Dataset* dataset = nullptr;
        data::DatasetSummary summary;
    };
    Result<void> prepare(const scene::Scene& scene, const Datasets& datasets);
    void planSteps(const scene::Scene& scene);

    std::map<std::string, Known> known_;
    reference::Bodies bodies_;
    std::vector<scene::Layer> layers_;
    std::vector<reference::LayerData> meshLayers_;  ///< As many as layers_; of meshes alone filled.
    /// Likewise; of voxels, for the last camera.
    struct Sampled {
        double stepWorld = 0.0;
        bool jitters = false;
    };
    std::vector<Sampled> sampled_;
    reference::Scratch scratch_;
    bool prepared_ = false;
};

}  // namespace volcast::pick
