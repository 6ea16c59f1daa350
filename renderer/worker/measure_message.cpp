#include "renderer/worker/measure_message.h"

#include <algorithm>
#include <utility>

#include <glm/gtc/packing.hpp>

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

std::vector<float> fromHalves(const std::string& bytes) {
    std::vector<float> values(bytes.size() / 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto low = static_cast<unsigned char>(bytes[2 * i]);
        const auto high = static_cast<unsigned char>(bytes[2 * i + 1]);
        values[i] = glm::unpackHalf1x16(static_cast<std::uint16_t>(low | high << 8U));
    }
    return values;
}

using WireAim = internal::v1::Measure;

WireAim::Aim toMessage(accuracy::Aim aim) {
    switch (aim) {
        case accuracy::Aim::kPicture: return WireAim::PICTURE;
        case accuracy::Aim::kEstimates: return WireAim::ESTIMATES;
        case accuracy::Aim::kTime: return WireAim::TIME;
        case accuracy::Aim::kCandidate: break;
    }
    return WireAim::CANDIDATE;
}

accuracy::Aim aimFrom(WireAim::Aim message) {
    if (message == WireAim::PICTURE) return accuracy::Aim::kPicture;
    if (message == WireAim::TIME) return accuracy::Aim::kTime;
    return message == WireAim::ESTIMATES ? accuracy::Aim::kEstimates : accuracy::Aim::kCandidate;
}

void put(const plan::SceneEvidence& estimates, internal::v1::Measured& message) {
    for (const auto& [layer, rows] : estimates) {
        for (const plan::Evidence& row : rows) {
            internal::v1::Measured::Estimate& added = *message.add_estimates();
            added.set_layer(layer);
            added.set_integrator(worker::toMessage(row.integrator));
            if (row.predictedMs) added.set_predicted_ms(*row.predictedMs);
            if (row.error) added.set_error(*row.error);
        }
    }
}

plan::SceneEvidence estimatesFrom(const internal::v1::Measured& message) {
    plan::SceneEvidence estimates;
    for (const internal::v1::Measured::Estimate& row : message.estimates()) {
        const auto integrator = integratorFrom(row.integrator());
        if (!integrator) continue;  // Not of our own worker.
        plan::Evidence& added = estimates[row.layer()].emplace_back();
        added.integrator = *integrator;
        if (row.has_predicted_ms()) added.predictedMs = row.predicted_ms();
        if (row.has_error()) added.error = row.error();
    }
    return estimates;
}

accuracy::Errors errorsFrom(const internal::v1::PixelErrors& message) {
    return {.max = message.max(),
            .rms = message.rms(),
            .share255 = message.share_255(),
            .share65535 = message.share_65535(),
            .pixels = message.pixels()};
}

}  // namespace

std::string halves(const std::vector<float>& values) {
    std::string bytes;
    bytes.reserve(2 * values.size());
    for (const float value : values) {
        const std::uint16_t half = glm::packHalf1x16(value);
        bytes.push_back(static_cast<char>(half & 0xffU));
        bytes.push_back(static_cast<char>(half >> 8U));
    }
    return bytes;
}

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
    message.set_aim(toMessage(job.aim));
    message.set_step(static_cast<std::uint32_t>(job.grid.step));
    message.set_refines(job.grid.refines);
    message.set_first_row(static_cast<std::uint32_t>(job.grid.firstRow));
    message.set_end_row(static_cast<std::uint32_t>(job.grid.endRow));
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
    message.set_off(halves(measurement.off));
    put(measurement.estimates, message);
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
    job.aim = aimFrom(message.aim());
    const auto atMost = [](std::uint32_t rows) {
        return static_cast<int>(std::min(rows, std::uint32_t{scene::kMaxPictureSide}));
    };
    job.grid = {.step = std::max(1, atMost(message.step())),
                .refines = message.refines(),
                .firstRow = atMost(message.first_row()),
                .endRow = atMost(message.end_row())};
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
            .integrator = message.integrator(),
            .off = fromHalves(message.off()),
            .estimates = estimatesFrom(message)};
}

}  // namespace volcast::worker
