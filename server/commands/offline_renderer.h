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
    /// The picture that is ready; what comes before it is drawn and forgotten.
    ///
    /// Errors: as the worker says, or kDeviceLost.
    Result<workers::RenderedFrame> draw(const workers::RenderRequest& request);
    /// What the last draw() took.
    struct Effort {
        int pictures = 0;
        std::uint64_t uploadedBytes = 0;
        double firstMs = 0.0;  ///< Until the first picture.
        double ms = 0.0;
    };
    [[nodiscard]] const Effort& effort() const noexcept { return effort_; }
    /// Errors: as accuracy::Meter::measure, or kDeviceLost.
    Result<accuracy::Measurement> measure(accuracy::Job job);

private:
    struct Outcome;

    OfflineRenderer() = default;

    Effort effort_;
    std::shared_ptr<Outcome> outcome_;
    std::unique_ptr<workers::RenderService> service_;
};

}  // namespace volcast::commands
