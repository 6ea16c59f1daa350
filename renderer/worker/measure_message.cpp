#include "renderer/worker/measure_message.h"

#include <utility>

#include "renderer/scene/validate.h"
#include "renderer/worker/frame_message.h"
#include "renderer/worker/scene_message.h"

namespace volcast::worker {

namespace {

void put(const accuracy::Errors& errors, internal::v1::PixelErrors* message) {
    message->set_max(errors.max);
    message->set_rms(errors.rms);
    message->set_share_255(errors.share255);
    message->set_share_65535(errors.share65535);
    message->set_pixels(errors.pixels);
}

accuracy::Errors errorsFrom(const internal::v1::PixelErrors& message) {
    return {.max = message.max(),
            .rms = message.rms(),
            .share255 = message.share_255(),
            .share65535 = message.share_65535(),
            .pixels = message.pixels()};
}

}  // namespace

internal::v1::Measure toMessage(const accuracy::Job& job) {
    internal::v1::Measure message;
    *message.mutable_scene() = toMessage(job.scene);
    message.set_width(static_cast<std::uint32_t>(job.size.x));
    message.set_height(static_cast<std::uint32_t>(job.size.y));
    message.set_layer(static_cast<std::uint32_t>(job.candidate.layer));
    message.set_integrator(toMessage(job.candidate.integrator));
    message.set_evaluator(toMessage(job.candidate.evaluator));
    message.set_frames(static_cast<std::uint32_t>(job.frames));
    message.set_pixels(job.pixels);
    message.set_counts_steps(job.countsSteps);
    return message;
}

internal::v1::Measured toMessage(const accuracy::Measurement& measurement) {
    internal::v1::Measured message;
    put(measurement.all, message.mutable_all());
    put(measurement.inner, message.mutable_inner());
    message.set_median_ms(measurement.medianMs);
    message.set_min_ms(measurement.minMs);
    message.set_max_ms(measurement.maxMs);
    message.set_frames(static_cast<std::uint32_t>(measurement.frames));
    message.set_cells_per_ray(measurement.cellsPerRay);
    message.set_walk_steps(measurement.walkSteps);
    message.set_cells_drawn(measurement.cellsDrawn);
    message.set_reference_rays(measurement.reference.rays);
    message.set_reference_ray_seconds(measurement.reference.raySeconds);
    message.set_reference_tree_seconds(measurement.reference.treeSeconds);
    message.set_evaluator(name(measurement.evaluator));
    message.set_integrator(measurement.integrator);
    return message;
}

Result<accuracy::Job> jobFrom(const internal::v1::Measure& message) {
    accuracy::Job job;
    job.size = {static_cast<int>(message.width()), static_cast<int>(message.height())};
    if (Result<void> valid = scene::validate(job.size); !valid) return std::move(valid).error();
    auto scene = sceneFrom(message.scene());
    if (!scene) return std::move(scene).error();
    const auto integrator = integratorFrom(message.integrator());
    if (!integrator) return integrator.error();
    const auto evaluator = meshEvaluatorFrom(message.evaluator());
    if (!evaluator) return evaluator.error();
    job.scene = *std::move(scene);
    job.candidate = {.layer = message.layer(), .integrator = *integrator, .evaluator = *evaluator};
    job.frames = static_cast<int>(message.frames());
    job.pixels = message.pixels();
    job.countsSteps = message.counts_steps();
    return job;
}

accuracy::Measurement measurementFrom(const internal::v1::Measured& message) {
    return {.all = errorsFrom(message.all()),
            .inner = errorsFrom(message.inner()),
            .medianMs = message.median_ms(),
            .minMs = message.min_ms(),
            .maxMs = message.max_ms(),
            .frames = static_cast<int>(message.frames()),
            .cellsPerRay = message.cells_per_ray(),
            .walkSteps = message.walk_steps(),
            .cellsDrawn = message.cells_drawn(),
            .reference = {.rays = message.reference_rays(),
                          .raySeconds = message.reference_ray_seconds(),
                          .treeSeconds = message.reference_tree_seconds()},
            .evaluator = evaluatorNamed(message.evaluator()),
            .integrator = message.integrator()};
}

}  // namespace volcast::worker
