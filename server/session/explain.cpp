#include "server/session/explain.h"

#include "renderer/worker/frame_message.h"

namespace volcast::session {
namespace {

void put(const plan::LayerPlan& layer, v1::LayerPlan& message) {
    message.set_layer(layer.layer);
    message.set_evaluator(worker::name(layer.evaluator));
    message.set_integrator(layer.integrator);
    message.set_drawn(layer.drawn);
    message.set_drawn_with(layer.drawnWith);
    message.set_step_world(layer.stepWorld);
    if (layer.predictedMs) message.set_predicted_ms(*layer.predictedMs);
    if (layer.errorBound) message.set_error_bound(*layer.errorBound);
    for (const plan::Effect& effect : layer.effects) {
        v1::Effect& added = *message.add_effects();
        added.set_name(effect.name);
        added.set_on(effect.on);
        added.set_reason(effect.reason);
    }
}

}  // namespace

v1::Plan planMessage(const workers::RenderedFrame& frame, std::uint32_t view,
                     std::uint64_t inputSeq) {
    v1::Plan message;
    message.set_view(view);
    message.set_plan_id(frame.plan.id);
    message.set_input_seq(inputSeq);
    for (const plan::LayerPlan& layer : frame.plan.layers) put(layer, *message.add_layers());
    v1::Timings& timings = *message.mutable_timings();
    timings.set_wait_ms(frame.waitMs);
    timings.set_upload_ms(frame.uploadMs);
    timings.set_draw_ms(frame.drawMs);
    timings.set_readback_ms(frame.readbackMs + frame.copyMs);
    v1::Work& work = *message.mutable_work();
    work.set_buffer_uploads(frame.work.bufferUploads);
    work.set_texture_uploads(frame.work.textureUploads);
    work.set_uploaded_bytes(frame.work.uploadedBytes);
    work.set_programs_built(frame.work.programsBuilt);
    work.set_draw_calls(frame.work.drawCalls);
    return message;
}

}  // namespace volcast::session
