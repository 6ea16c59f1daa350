#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>

#include "server/workers/render_service.h"

namespace volcast::session {

/// Where news of one view are brought to; called on the render service's thread, must not block.
struct ViewTarget {
    std::function<void(workers::RenderedFrame)> rendered;
    std::function<void(std::uint64_t tag, Error)> failed;
    std::function<void(std::uint64_t tag, Result<accuracy::Measurement>)> measured = {};
    std::function<void(std::uint64_t tag, Result<std::optional<scene::Picked>>)> picked = {};
    std::function<void()> recovering = {};
};

/// Numbers views in the whole server and hands the render service's news to the right one.
///
/// Any thread. A target that is being called while it is removed may finish that call.
class ViewRouter {
public:
    /// A number that no other view has or had.
    std::uint64_t reserve();
    void add(std::uint64_t view, ViewTarget target);
    void remove(std::uint64_t view);
    [[nodiscard]] std::size_t size();
    /// The events to create the render service with; this router must outlive it.
    workers::RenderEvents events();

private:
    [[nodiscard]] ViewTarget find(std::uint64_t view);

    std::mutex mutex_;
    std::map<std::uint64_t, ViewTarget> targets_;
    std::uint64_t last_ = 0;
};

}  // namespace volcast::session
