#pragma once

#include <mutex>
#include <optional>
#include <utility>

#include "server/workers/render_service.h"

namespace volcast::workers {

/// Where faults are asked for. A server has one only where it was told to allow them.
///
/// Any thread.
class FaultSwitch {
public:
    /// `render` must outlive it.
    void connect(RenderService& render) noexcept { render_ = &render; }

    /// Lets the worker of `view`, its spare or the next import fail.
    void inject(std::uint64_t view, const worker::FaultSpec& fault) {
        if (worker::struckBy(fault.fault) != worker::FaultyProcess::kImport) {
            return render_->injectFault(view, fault);
        }
        const std::scoped_lock lock{mutex_};
        ofNextImport_ = fault;
    }
    /// For ImportSettings::fault.
    std::optional<worker::FaultSpec> takeForImport() {
        const std::scoped_lock lock{mutex_};
        return std::exchange(ofNextImport_, std::nullopt);
    }

private:
    RenderService* render_ = nullptr;
    std::mutex mutex_;
    std::optional<worker::FaultSpec> ofNextImport_;
};

}  // namespace volcast::workers
