#include "server/commands/offline_renderer.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace volcast::commands {

namespace {

/// What one thread says, for one that waits.
template <class T>
class Handover {
public:
    void set(T value) {
        const std::scoped_lock lock{mutex_};
        value_ = std::move(value);
        came_.notify_all();
    }

    T take() {
        std::unique_lock lock{mutex_};
        came_.wait(lock, [this] { return value_.has_value(); });
        return *std::exchange(value_, std::nullopt);
    }

private:
    std::mutex mutex_;
    std::condition_variable came_;
    std::optional<T> value_;
};

}  // namespace

struct OfflineRenderer::Outcome {
    Handover<Result<workers::RenderedFrame>> frame;
    Handover<Result<accuracy::Measurement>> measurement;
};

Result<OfflineRenderer> OfflineRenderer::create(const workers::RenderSettings& settings) {
    OfflineRenderer renderer;
    renderer.outcome_ = std::make_shared<Outcome>();
    auto service = workers::RenderService::create(
        settings, {.rendered = [outcome = renderer.outcome_](
                                   workers::RenderedFrame frame) { outcome->frame.set(frame); },
                   .failed = [outcome = renderer.outcome_](
                                 std::uint64_t, std::uint64_t,
                                 Error error) { outcome->frame.set(std::move(error)); },
                   .measured =
                       [outcome = renderer.outcome_](std::uint64_t, std::uint64_t,
                                                     Result<accuracy::Measurement> result) {
                           outcome->measurement.set(std::move(result));
                       }});
    if (!service) return std::move(service).error();
    renderer.service_ = *std::move(service);
    return renderer;
}

Result<workers::RenderedFrame> OfflineRenderer::draw(const workers::RenderRequest& request) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    effort_ = {};
    for (;;) {
        service_->submit(request);
        auto frame = outcome_->frame.take();
        if (!frame) return frame;
        effort_.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (effort_.pictures == 0) effort_.firstMs = effort_.ms;
        ++effort_.pictures;
        effort_.uploadedBytes += frame->work.uploadedBytes;
        if (frame->ready) return frame;
    }
}

Result<accuracy::Measurement> OfflineRenderer::measure(accuracy::Job job) {
    service_->measure({.view = 1, .tag = 0, .job = std::move(job)});
    return outcome_->measurement.take();
}

}  // namespace volcast::commands
