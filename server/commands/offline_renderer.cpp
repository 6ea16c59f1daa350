#include "server/commands/offline_renderer.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace volcast::commands {

/// What the service's thread says, for the thread that waits.
struct OfflineRenderer::Outcome {
    std::mutex mutex;
    std::condition_variable came;
    std::optional<Result<workers::RenderedFrame>> result;

    void set(Result<workers::RenderedFrame> value) {
        const std::scoped_lock lock{mutex};
        result = std::move(value);
        came.notify_all();
    }

    Result<workers::RenderedFrame> take() {
        std::unique_lock lock{mutex};
        came.wait(lock, [this] { return result.has_value(); });
        return *std::exchange(result, std::nullopt);
    }
};

Result<OfflineRenderer> OfflineRenderer::create(const workers::RenderSettings& settings) {
    OfflineRenderer renderer;
    renderer.outcome_ = std::make_shared<Outcome>();
    auto service = workers::RenderService::create(
        settings,
        {.rendered = [outcome = renderer.outcome_](
                         workers::RenderedFrame frame) { outcome->set(std::move(frame)); },
         .failed = [outcome = renderer.outcome_](std::uint64_t, std::uint64_t,
                                                 Error error) { outcome->set(std::move(error)); },
         .recovering = {}});
    if (!service) return std::move(service).error();
    renderer.service_ = *std::move(service);
    return renderer;
}

Result<workers::RenderedFrame> OfflineRenderer::draw(workers::RenderRequest request) {
    service_->submit(std::move(request));
    return outcome_->take();
}

}  // namespace volcast::commands
