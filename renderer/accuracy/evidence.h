#pragma once

#include <deque>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "renderer/accuracy/meter.h"
#include "renderer/plan/evidence.h"

namespace volcast::accuracy {

/// What the walk takes, by model and integrator, on this machine: a part for any picture and a part
/// for each cell on each ray. Measured once for each model, on pictures of two sizes, and kept in a
/// file.
class Costs {
public:
    using Key = std::pair<scene::RayModel, scene::Integrator>;

    /// `file`: where costs are kept; empty: nowhere. `machine`: costs of another are not used.
    Costs(std::string file, std::string machine)
        : file_{std::move(file)}, machine_{std::move(machine)} {}

    /// Measures on a small mesh of its own, with `renderer`, what the file does not hold of
    /// `model`.
    ///
    /// Errors: as Meter::measure. A file that cannot be written is left.
    Result<void> prepare(scene::Renderer& renderer, scene::RayModel model);
    /// Milliseconds of a picture; needs prepare() of its model.
    [[nodiscard]] double predictMs(const Key& key, scene::PictureSize size,
                                   double cellsPerRay) const;

private:
    [[nodiscard]] bool know(scene::RayModel model) const;
    void load();  ///< Keeps what is known.
    void save() const;
    Result<void> measure(scene::Renderer& renderer, scene::RayModel model);

    std::string file_, machine_;
    struct Cost {
        double pictureMs = 0.0;
        double cellNs = 0.0;
    };

    std::map<Key, Cost> costs_;
};

/// Gathers what plans need to know where a scene bounds error or time, and keeps it: errors hold
/// for a scene whatever its camera, until its data, maps or models change. What voxels take is
/// not kept: it is measured where it is asked for.
class EvidenceKeeper {
public:
    EvidenceKeeper(scene::Renderer& renderer, Meter& meter, Costs costs)
        : renderer_{renderer}, meter_{meter}, costs_{std::move(costs)} {}

    /// Empty where the scene bounds nothing. Layers that cannot be measured are left out.
    ///
    /// Errors: kDeviceLost.
    Result<plan::SceneEvidence> of(const scene::Scene& scene, scene::PictureSize size);
    /// The same, and what a picture takes of voxels, layer by layer: from the times of smaller
    /// pictures of this very view, drawn now in each way, for as many pixels as `size` has. In
    /// parts of one picture at most: empty: to be called again with the same; others begin anew.
    ///
    /// Errors: kDeviceLost.
    Result<std::optional<plan::SceneEvidence>> advanceEstimates(const scene::Scene& scene,
                                                                scene::PictureSize size);
    /// To be called when the dataset is replaced or removed.
    void forget(const std::string& dataset);

private:
    struct Known {
        scene::Scene scene;  ///< Without camera and accuracy.
        std::size_t layer = 0;
        bool withErrors = false;
        double cellsPerRay = 0.0;
        std::map<scene::Integrator, double> errors = {};  ///< Largest, in 1/255.
    };
    [[nodiscard]] bool isMesh(const scene::Layer& layer) const;
    Result<const Known*> known(const scene::Scene& scene, scene::PictureSize size,
                               std::size_t layer);
    /// Estimates between their parts.
    struct Estimating {
        scene::Scene scene;
        scene::PictureSize size{0};
        plan::SceneEvidence evidence = {};
        std::deque<Candidate> untimed = {};  ///< The first is at hand.
    };
    Result<Estimating> beginEstimates(const scene::Scene& scene, scene::PictureSize size);
    /// Milliseconds of a picture of one layer, drawn as the candidate says; empty: not known yet.
    Result<std::optional<double>> timeOf(const scene::Scene& scene, scene::PictureSize size,
                                         const Candidate& candidate);

    scene::Renderer& renderer_;
    Meter& meter_;
    Costs costs_;
    std::list<Known> known_;  ///< The last used first.
    std::optional<Estimating> estimating_;
};

}  // namespace volcast::accuracy
