#include "server/session/view_router.h"

#include <utility>

namespace volcast::session {

std::uint64_t ViewRouter::reserve() {
    const std::lock_guard lock{mutex_};
    return ++last_;
}

void ViewRouter::add(std::uint64_t view, ViewTarget target) {
    const std::lock_guard lock{mutex_};
    targets_.emplace(view, std::move(target));
}

void ViewRouter::remove(std::uint64_t view) {
    const std::lock_guard lock{mutex_};
    targets_.erase(view);
}

std::size_t ViewRouter::size() {
    const std::lock_guard lock{mutex_};
    return targets_.size();
}

ViewTarget ViewRouter::find(std::uint64_t view) {
    const std::lock_guard lock{mutex_};
    const auto found = targets_.find(view);
    return found == targets_.end() ? ViewTarget{} : found->second;
}

workers::RenderEvents ViewRouter::events() {
    return {
        .rendered =
            [this](workers::RenderedFrame frame) {
                const ViewTarget target = find(frame.view);
                if (target.rendered) target.rendered(std::move(frame));
            },
        .failed =
            [this](std::uint64_t view, std::uint64_t tag, Error error) {
                const ViewTarget target = find(view);
                if (target.failed) target.failed(tag, std::move(error));
            },
        .measured =
            [this](std::uint64_t view, std::uint64_t tag, Result<accuracy::Measurement> result) {
                const ViewTarget target = find(view);
                if (target.measured) target.measured(tag, std::move(result));
            },
        .picked =
            [this](std::uint64_t view, std::uint64_t tag,
                   Result<std::optional<scene::Picked>> result) {
                const ViewTarget target = find(view);
                if (target.picked) target.picked(tag, std::move(result));
            },
        .recovering =
            [this](const std::vector<std::uint64_t>& views) {
                for (const std::uint64_t view : views) {
                    const ViewTarget target = find(view);
                    if (target.recovering) target.recovering();
                }
            },
    };
}

}  // namespace volcast::session
