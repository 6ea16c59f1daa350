#pragma once

#include <memory>

#include "server/workers/render_service.h"

namespace volcast::commands {

/// Draws one request after the other, each waited for: a render service without mailboxes.
class OfflineRenderer {
public:
    /// Errors: as workers::RenderService::create.
    static Result<OfflineRenderer> create(const workers::RenderSettings& settings);

    [[nodiscard]] workers::RenderService& service() const { return *service_; }
    /// Errors: as the worker says, or kDeviceLost.
    Result<workers::RenderedFrame> draw(workers::RenderRequest request);
    /// Errors: as accuracy::Meter::measure, or kDeviceLost.
    Result<accuracy::Measurement> measure(accuracy::Job job);

private:
    struct Outcome;

    OfflineRenderer() = default;

    std::shared_ptr<Outcome> outcome_;
    std::unique_ptr<workers::RenderService> service_;
};

}  // namespace volcast::commands
