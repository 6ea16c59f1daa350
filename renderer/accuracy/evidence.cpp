#include "renderer/accuracy/evidence.h"

#include <algorithm>
#include <variant>

#include "renderer/plan/method.h"
#include "renderer/scene/ray_models.h"

namespace volcast::accuracy {
namespace {

constexpr std::uint64_t kPixels = 256;  // Compared, of a small picture of the same view.
constexpr int kLongerSide = 96;
constexpr std::size_t kMostKept = 16;
/// Longer side of the pictures of voxels that are timed.
constexpr int kTimedSide = 128;
constexpr int kTimedFrames = 3;  // The fastest counts: other work only adds to it.

/// What errors depend on, as far as they are kept.
scene::Scene essence(scene::Scene scene) {
    scene.camera = {};
    scene.accuracy = {};
    scene.background = {};
    return scene;
}

scene::PictureSize smallOf(scene::PictureSize size, int side = kLongerSide) {
    const int longer = std::max(size.x, size.y);
    if (longer <= side) return size;
    return glm::max(size * side / longer, scene::PictureSize{1});
}

double pixelsOf(scene::PictureSize size) {
    return static_cast<double>(size.x) * size.y;
}

}  // namespace

bool EvidenceKeeper::isMesh(const scene::Layer& layer) const {
    const data::Dataset* dataset = renderer_.dataset(layer.dataset);
    return dataset != nullptr && std::holds_alternative<data::Mesh>(*dataset);
}

Result<const EvidenceKeeper::Known*> EvidenceKeeper::known(const scene::Scene& scene,
                                                           scene::PictureSize size,
                                                           std::size_t layer) {
    const bool withErrors = scene.accuracy.kind == scene::Accuracy::Kind::kErrorBound;
    scene::Scene wanted = essence(scene);
    const auto found = std::ranges::find_if(known_, [&](const Known& one) {
        return one.layer == layer && (one.withErrors || !withErrors) && one.scene == wanted;
    });
    if (found != known_.end()) {
        known_.splice(known_.begin(), known_, found);
        return &known_.front();
    }
    Known made{.scene = std::move(wanted), .layer = layer, .withErrors = withErrors};
    const scene::PictureSize small = smallOf(size);
    const auto cells = meter_.cellsPerRay(scene, small, kPixels);
    if (!cells) return cells.error();
    made.cellsPerRay = *cells;
    if (withErrors) {
        const scene::Layer& own = scene.layers[layer];
        for (const auto& row : scene::row(own.model).integratorsOf(isMesh(own))) {
            const auto measured =
                meter_.measure({.scene = scene,
                                .size = small,
                                .candidate = {.layer = layer, .integrator = row.integrator},
                                .frames = 0,
                                .pixels = kPixels});
            if (!measured) return measured.error();
            made.errors[row.integrator] = 255.0 * measured->inner.max;
        }
    }
    known_.push_front(std::move(made));
    if (known_.size() > kMostKept) known_.pop_back();
    return &known_.front();
}

Result<plan::SceneEvidence> EvidenceKeeper::of(const scene::Scene& scene, scene::PictureSize size) {
    plan::SceneEvidence evidence;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const scene::Layer& layer = scene.layers[i];
        if (!layer.visible || !plan::needsEvidence(layer, scene.accuracy)) continue;
        const auto found = known(scene, size, i);
        const bool mesh = isMesh(layer);
        Result<void> costs = found ? Result<void>{} : Result<void>{found.error()};
        if (found && mesh) costs = costs_.prepare(renderer_, layer.model);
        if (!costs) {
            if (costs.error().code == ErrorCode::kDeviceLost) return costs.error();
            continue;  // Drawn as well as can be.
        }
        std::vector<plan::Evidence>& rows = evidence[layer.id];
        for (const auto& row : scene::row(layer.model).integratorsOf(mesh)) {
            plan::Evidence& one = rows.emplace_back();
            one.integrator = row.integrator;
            if (mesh) {
                one.predictedMs =
                    costs_.predictMs({layer.model, row.integrator}, size, (*found)->cellsPerRay);
            }
            const auto error = (*found)->errors.find(row.integrator);
            if (error != (*found)->errors.end()) one.error = error->second;
        }
    }
    return evidence;
}

Result<std::optional<double>> EvidenceKeeper::timeOf(const scene::Scene& scene,
                                                     scene::PictureSize size,
                                                     const Candidate& candidate) {
    Job job{.scene = scene,
            .size = smallOf(size, kTimedSide),
            .aim = Aim::kTime,
            .frames = kTimedFrames};
    job.scene.accuracy = {};
    for (scene::Layer& layer : job.scene.layers) layer.visible = false;
    scene::Layer& own = job.scene.layers[candidate.layer];
    own.visible = true;
    own.integrator = candidate.integrator;
    const auto measured = meter_.advance(job);
    if (!measured) return measured.error();
    if (!*measured) return std::optional<double>{};
    return std::optional{(*measured)->minMs * pixelsOf(size) / pixelsOf(job.size)};
}

Result<EvidenceKeeper::Estimating> EvidenceKeeper::beginEstimates(const scene::Scene& scene,
                                                                  scene::PictureSize size) {
    auto evidence = of(scene, size);
    if (!evidence) return evidence.error();
    Estimating begun{.scene = scene, .size = size, .evidence = *std::move(evidence)};
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const auto rows = begun.evidence.find(scene.layers[i].id);
        if (rows == begun.evidence.end() || isMesh(scene.layers[i])) continue;
        for (const plan::Evidence& one : rows->second) {
            begun.untimed.push_back({.layer = i, .integrator = one.integrator});
        }
    }
    return begun;
}

Result<std::optional<plan::SceneEvidence>> EvidenceKeeper::advanceEstimates(
    const scene::Scene& scene, scene::PictureSize size) {
    if (!estimating_ || estimating_->scene != scene || estimating_->size != size) {
        auto begun = beginEstimates(scene, size);
        if (!begun) return begun.error();
        estimating_ = *std::move(begun);
    }
    if (!estimating_->untimed.empty()) {
        const Candidate& candidate = estimating_->untimed.front();
        const auto ms = timeOf(scene, size, candidate);
        if (!ms && ms.error().code == ErrorCode::kDeviceLost) return ms.error();
        if (ms && !*ms) return std::optional<plan::SceneEvidence>{};
        auto& rows = estimating_->evidence.at(scene.layers[candidate.layer].id);
        const auto row = std::ranges::find(rows, candidate.integrator, &plan::Evidence::integrator);
        if (ms) row->predictedMs = **ms;
        estimating_->untimed.pop_front();
        if (!estimating_->untimed.empty()) return std::optional<plan::SceneEvidence>{};
    }
    return std::optional{std::exchange(estimating_, std::nullopt)->evidence};
}

void EvidenceKeeper::forget(const std::string& dataset) {
    estimating_.reset();
    std::erase_if(known_, [&dataset](const Known& one) {
        return std::ranges::any_of(one.scene.layers, [&dataset](const scene::Layer& layer) {
            return layer.dataset == dataset;
        });
    });
}

}  // namespace volcast::accuracy
