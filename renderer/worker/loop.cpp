#include "renderer/worker/loop.h"

#include <chrono>
#include <ctime>
#include <sys/resource.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/scene/validate.h"
#include "renderer/worker/frame_message.h"
#include "renderer/worker/measure_message.h"
#include "renderer/worker/pick_message.h"
#include "renderer/worker/scene_message.h"
#include "renderer/worker/warm_up.h"

namespace volcast::worker {

namespace {

namespace wire = volcast::internal::v1;

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// CPU time of all threads of this process.
double cpuMs() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// The most memory this process has held so far.
double peakMb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void put(const scene::Counters& work, wire::Counters* message) {
    message->set_buffer_uploads(work.bufferUploads);
    message->set_texture_uploads(work.textureUploads);
    message->set_uploaded_bytes(work.uploadedBytes);
    message->set_programs_built(work.programsBuilt);
    message->set_draw_calls(work.drawCalls);
    message->set_frames_drawn(work.framesDrawn);
}

void log(const char* event, const Error& error) {
    spdlog::error(R"(event={} error="{}")", event, base::printable(error.message, 1000));
}

Error oneDescriptorExpected(const std::string& message, std::size_t count) {
    return fail(ErrorCode::kInvalidArgument,
                message + " came with " + std::to_string(count) + " descriptors instead of 1");
}

}  // namespace

ExitCode Loop::run() {
    for (;;) {
        wire::ToWorker message;
        auto descriptors = channel_.receive(message, std::chrono::milliseconds{-1});
        if (!descriptors) {
            if (descriptors.error().code == ErrorCode::kDeviceLost) return kExitDone;
            log("message_refused", descriptors.error());
            return kExitProtocol;
        }
        if (Result<void> done = handle(message, **descriptors); !done) {
            if (deviceLost_) log("device_lost", done.error());
            if (deviceLost_) return kExitDeviceLost;
            if (done.error().code == ErrorCode::kDeviceLost) return kExitDone;
            log("message_refused", done.error());
            return kExitProtocol;
        }
    }
}

Result<void> Loop::handle(const wire::ToWorker& message, const Descriptors& descriptors) {
    if (fault_) fault_->received(message);
    switch (message.body_case()) {
        case wire::ToWorker::kAddDataset: {
            return addDataset(message.add_dataset().id(), descriptors);
        }
        case wire::ToWorker::kRemoveDataset: {
            meter_.forget(message.remove_dataset().id());
            evidence_.forget(message.remove_dataset().id());
            picker_.forget(message.remove_dataset().id());
            renderer_.removeDataset(message.remove_dataset().id());
            return {};
        }
        case wire::ToWorker::kRender: return render(message.render(), descriptors);
        case wire::ToWorker::kDropView: {
            renderer_.dropView(message.drop_view().view());
            partsCpuMs_.erase(message.drop_view().view());
            return {};
        }
        case wire::ToWorker::kPing: {
            wire::FromWorker answer;
            answer.mutable_pong()->set_token(message.ping().token());
            return reply(std::move(answer));
        }
        case wire::ToWorker::kWarmUp: return warmUp(message.warm_up().step());
        case wire::ToWorker::kMeasure: return measure(message.measure());
        case wire::ToWorker::kPick: return pick(message.pick());
        case wire::ToWorker::kStopMeasuring: {
            meter_.stop();
            return {};
        }
        case wire::ToWorker::kArmFault: {
            const auto fault = parseFault(message.arm_fault().fault());
            if (!fault) return fault.error();
            if (auto armed = arm(*fault); !armed) return armed;
            fault_->received(message);
            return {};
        }
        case wire::ToWorker::BODY_NOT_SET: break;
    }
    return fail(ErrorCode::kInvalidArgument, "the server sent a message of an unknown kind");
}

Result<void> Loop::addDataset(const std::string& id, const Descriptors& descriptors) {
    if (descriptors.size() != 1) return oneDescriptorExpected("a dataset", descriptors.size());
    const auto start = Clock::now();
    wire::FromWorker answer;
    // The server has accepted the very bytes, which are sealed.
    if (auto dataset = data::unpack(descriptors.front(), data::Trust::kVoxelsChecked); dataset) {
        meter_.forget(id);
        evidence_.forget(id);
        picker_.forget(id);
        renderer_.addDataset(id, *std::move(dataset));
        answer.mutable_dataset_added()->set_id(id);
        answer.mutable_dataset_added()->set_ms(millisecondsSince(start));
    } else {
        *answer.mutable_failed() = toMessage(dataset.error());
        answer.mutable_failed()->set_dataset(id);
    }
    return reply(std::move(answer));
}

Result<void> Loop::warmUp(std::uint32_t step) {
    // What fails here fails again, and is told, when a scene needs it.
    if (auto done = worker::warmUp(renderer_, step); !done) {
        if (done.error().code == ErrorCode::kDeviceLost) return deviceLoss(done.error());
        log("warm_up_failed", done.error());
    }
    wire::FromWorker answer;
    answer.mutable_warmed_up()->set_step(step);
    answer.mutable_warmed_up()->set_more(step + 1 < kWarmUpSteps);
    return reply(std::move(answer));
}

Result<wire::FromWorker> Loop::draw(const wire::Render& request, const Descriptors& descriptors) {
    const scene::PictureSize size{static_cast<int>(request.width()),
                                  static_cast<int>(request.height())};
    if (Result<void> valid = scene::validate(size); !valid) return std::move(valid).error();
    if (request.new_slot()) {
        if (auto done = slots_.replace(request.slot(), descriptors.front()); !done) {
            return std::move(done).error();
        }
    }
    auto target = slots_.target(request.slot(), size, request.want_float());
    if (!target) return std::move(target).error();
    auto scene = sceneFrom(request.scene());
    if (!scene) return std::move(scene).error();

    target->partMs = request.part_ms();
    const double cpuBefore = cpuMs();
    const auto evidence = evidence_.of(*scene, size);
    if (!evidence) return evidence.error();
    auto info = renderer_.render(request.view(), *scene, size, *target, *evidence);
    if (!info) return std::move(info).error();
    wire::FromWorker answer;
    double& partsCpuMs = partsCpuMs_[request.view()];
    partsCpuMs += cpuMs() - cpuBefore;
    if (!info->finished) {
        answer.mutable_rendering()->set_request(request.request());
        return answer;
    }
    wire::Rendered& rendered = *answer.mutable_rendered();
    rendered.set_request(request.request());
    rendered.set_view(request.view());
    rendered.set_slot(request.slot());
    rendered.set_width(request.width());
    rendered.set_height(request.height());
    put(info->plan, &rendered);
    rendered.set_upload_ms(info->uploadMs);
    rendered.set_draw_ms(info->drawMs);
    rendered.set_readback_ms(info->readbackMs);
    rendered.set_cpu_ms(partsCpuMs);
    partsCpuMs_.erase(request.view());
    rendered.set_peak_mb(peakMb());
    rendered.set_drawn(info->drawn);
    rendered.set_ready(info->ready);
    put(info->work, rendered.mutable_work());
    return answer;
}

Result<void> Loop::render(const wire::Render& request, const Descriptors& descriptors) {
    const std::size_t expected = request.new_slot() ? 1 : 0;
    if (descriptors.size() != expected) {
        return oneDescriptorExpected("a new frame slot", descriptors.size());
    }
    auto answer = draw(request, descriptors);
    if (Result<void> alive = checkDevice(); !alive) return alive;
    if (!answer) {
        partsCpuMs_.erase(request.view());
        wire::Failed failed;
        failed.set_request(request.request());
        failed.set_view(request.view());
        return refuse(answer.error(), std::move(failed));
    }
    return reply(*std::move(answer));
}

Result<void> Loop::measure(const wire::Measure& request) {
    const auto job = jobFrom(request);
    const auto measured =
        job ? advance(*job) : Result<std::optional<accuracy::Measurement>>{job.error()};
    if (Result<void> alive = checkDevice(); !alive) return alive;
    if (!measured) {
        wire::Failed failed;
        failed.set_request(request.request());
        return refuse(measured.error(), std::move(failed));
    }
    wire::FromWorker answer;
    if (*measured) {
        *answer.mutable_measured() = toMessage(**measured);
        answer.mutable_measured()->set_request(request.request());
    } else {
        answer.mutable_measuring()->set_request(request.request());
    }
    return reply(std::move(answer));
}

Result<std::optional<accuracy::Measurement>> Loop::advance(const accuracy::Job& job) {
    using Part = std::optional<accuracy::Measurement>;
    if (job.aim == accuracy::Aim::kCandidate) return meter_.advance(job);
    if (job.aim == accuracy::Aim::kEstimates) {
        auto estimates = evidence_.advanceEstimates(job.scene, job.size);
        if (!estimates) return estimates.error();
        if (!*estimates) return Part{};
        accuracy::Measurement measured;
        measured.estimates = **std::move(estimates);
        return Part{std::move(measured)};
    }
    const auto evidence = evidence_.of(job.scene, job.size);
    if (!evidence) return evidence.error();
    return meter_.advance(job, *evidence);
}

Result<void> Loop::pick(const wire::Pick& request) {
    using Place = std::optional<scene::Picked>;
    const auto job = jobFrom(request);
    const auto place =
        job ? picker_.pick(job->scene, job->size, job->pixel,
                           [this](const std::string& id) { return renderer_.dataset(id); })
            : Result<Place>{job.error()};
    if (!place) {
        wire::Failed failed;
        failed.set_request(request.request());
        return refuse(place.error(), std::move(failed));
    }
    wire::FromWorker answer;
    answer.mutable_picked()->set_request(request.request());
    *answer.mutable_picked()->mutable_place() = toMessage(*place);
    return reply(std::move(answer));
}

Result<void> Loop::checkDevice() {
    if (device_.resetStatus() == gpu::ResetStatus::kNone) return {};
    return deviceLoss(fail(ErrorCode::kDeviceLost, "the GPU was reset while drawing"));
}

Error Loop::deviceLoss(Error error) {
    deviceLost_ = true;
    device_.abandon();
    return error;
}

Result<void> Loop::refuse(const Error& error, wire::Failed failed) {
    if (error.code == ErrorCode::kDeviceLost) return deviceLoss(error);
    wire::FromWorker answer;
    failed.MergeFrom(toMessage(error));
    *answer.mutable_failed() = std::move(failed);
    return reply(std::move(answer));
}

Result<void> Loop::arm(const FaultSpec& fault) {
    auto armed = ArmedFault::arm(fault);
    if (!armed) return armed.error();
    fault_ = *std::move(armed);
    return {};
}

Result<void> Loop::reply(wire::FromWorker message) {
    if (!fault_) return channel_.send(message);
    const auto answered = fault_->answers(message, channel_);
    if (!answered) return deviceLoss(answered.error());
    return *answered ? Result<void>{} : channel_.send(message);
}

}  // namespace volcast::worker
