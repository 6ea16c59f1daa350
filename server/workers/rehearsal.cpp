#include "server/workers/rehearsal.h"

namespace volcast::workers {

namespace {

/// What decides on data and programs.
std::string kindOf(const RenderRequest& request) {
    std::string kind;
    for (const scene::Layer& layer : request.scene.layers) {
        kind += layer.dataset + '\n' + layer.field + '\n' + layer.densityField + '\n' +
                std::to_string(static_cast<int>(layer.model)) + '\n';
    }
    return kind;
}

}  // namespace

bool Rehearsal::wants(int pid, const RenderRequest& request) const {
    const std::string kind = kindOf(request);
    const bool known = pid == pid_ && kind == kind_;
    return !underWay_ && !known && kind != fatal_;
}

void Rehearsal::began(int pid, std::uint64_t number, const RenderRequest& request) {
    underWay_ = {.pid = pid, .number = number};
    pid_ = pid;
    kind_ = kindOf(request);
}

bool Rehearsal::ended(std::uint64_t number) {
    if (!underWay_ || underWay_->number != number) return false;
    underWay_.reset();
    return true;
}

void Rehearsal::workerLost(int pid) {
    if (!underWay_ || underWay_->pid != pid) return;
    fatal_ = kind_;
    underWay_.reset();
}

}  // namespace volcast::workers
