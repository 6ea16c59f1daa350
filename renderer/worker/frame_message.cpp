#include "renderer/worker/frame_message.h"

#include <array>
#include <string_view>

namespace volcast::worker {

namespace {

constexpr std::array kEvaluators{plan::Evaluator::kMeshWalk,
                                 plan::Evaluator::kMeshProjection,
                                 plan::Evaluator::kMeshProjectionFaces,
                                 plan::Evaluator::kMeshRaster,
                                 plan::Evaluator::kVolumeMarch,
                                 plan::Evaluator::kVolumeSlices,
                                 plan::Evaluator::kVolumeSliceInstances,
                                 plan::Evaluator::kCrossSections};

}  // namespace

const char* name(plan::Evaluator evaluator) noexcept {
    switch (evaluator) {
        case plan::Evaluator::kMeshWalk: return "mesh walk";
        case plan::Evaluator::kMeshProjection: return "mesh projection";
        case plan::Evaluator::kMeshProjectionFaces: return "mesh projection of all faces";
        case plan::Evaluator::kMeshRaster: return "mesh raster";
        case plan::Evaluator::kVolumeMarch: return "volume march";
        case plan::Evaluator::kVolumeSlices: return "volume slices";
        case plan::Evaluator::kVolumeSliceInstances: return "volume slices as instances";
        case plan::Evaluator::kCrossSections: return "cross-sections";
    }
    return "";
}

plan::Evaluator evaluatorNamed(std::string_view text) {
    for (const plan::Evaluator evaluator : kEvaluators) {
        if (text == name(evaluator)) return evaluator;
    }
    return plan::Evaluator::kMeshWalk;  // Both ends are of one build: never reached.
}

void put(const plan::FramePlan& plan, internal::v1::Rendered* message) {
    message->set_plan_id(plan.id);
    for (const plan::LayerPlan& layer : plan.layers) {
        internal::v1::LayerPlan* added = message->add_layers();
        added->set_layer(layer.layer);
        added->set_evaluator(name(layer.evaluator));
        added->set_integrator(layer.integrator);
        added->set_drawn(layer.drawn);
        added->set_drawn_with(layer.drawnWith);
        if (layer.predictedMs) added->set_predicted_ms(*layer.predictedMs);
        if (layer.errorBound) added->set_error_bound(*layer.errorBound);
        added->set_step_world(layer.stepWorld);
        for (const plan::Effect& effect : layer.effects) {
            internal::v1::Effect* entry = added->add_effects();
            entry->set_name(effect.name);
            entry->set_on(effect.on);
            entry->set_reason(effect.reason);
        }
    }
}

plan::FramePlan planFrom(const internal::v1::Rendered& message) {
    plan::FramePlan plan{.id = message.plan_id(), .layers = {}};
    for (const internal::v1::LayerPlan& layer : message.layers()) {
        plan::LayerPlan& added = plan.layers.emplace_back();
        added.layer = layer.layer();
        added.evaluator = evaluatorNamed(layer.evaluator());
        added.integrator = layer.integrator();
        added.drawn = layer.drawn();
        added.drawnWith = layer.drawn_with();
        if (layer.has_predicted_ms()) added.predictedMs = layer.predicted_ms();
        if (layer.has_error_bound()) added.errorBound = layer.error_bound();
        added.stepWorld = layer.step_world();
        for (const internal::v1::Effect& effect : layer.effects()) {
            added.effects.push_back(
                {.name = effect.name(), .on = effect.on(), .reason = effect.reason()});
        }
    }
    return plan;
}

internal::v1::Failed toMessage(const Error& error) {
    internal::v1::Failed message;
    message.set_code(static_cast<int>(error.code));
    message.set_message(error.message);
    message.set_field(error.field);
    return message;
}

Error errorFrom(const internal::v1::Failed& message) {
    const int code = message.code();
    const bool known = code >= 0 && code <= static_cast<int>(ErrorCode::kTimeout);
    return Error{.code = known ? static_cast<ErrorCode>(code) : ErrorCode::kUnsupported,
                 .message = message.message(),
                 .field = message.field()};
}

}  // namespace volcast::worker
