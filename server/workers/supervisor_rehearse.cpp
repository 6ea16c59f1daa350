// What the spare does while it waits: see rehearsal.h.
#include <sys/stat.h>

#include "server/workers/supervisor.h"

namespace volcast::workers {

bool Supervisor::mayRehearse(const RenderRequest& request) const {
    if (!rehearsal_.wants(spare_->pid(), request)) return false;
    std::uint64_t bytes = 0;
    for (const scene::Layer& layer : request.scene.layers) {
        const auto packed = datasets_.find(layer.dataset);
        struct stat about {};
        if (packed == datasets_.end() || ::fstat(packed->second->get(), &about) != 0) return false;
        bytes += static_cast<std::uint64_t>(about.st_size);
    }
    return bytes <= Rehearsal::kMostBytes;
}

bool Supervisor::spareReady() const {
    if (!spare_ || !spare_->ready() || !spare_->warm() || rehearsal_.underWay()) return false;
    const RenderRequest* last = views_.lastDrawn();
    return last == nullptr || !mayRehearse(*last);
}

void Supervisor::rehearse() {
    if (!spare_ || !spare_->ready() || !spare_->warm() || inFlight_) return;
    const RenderRequest* last = views_.lastDrawn();
    if (last == nullptr || !mayRehearse(*last)) return;
    if (!spare_->render(nextNumber_, *last, settings_.frameDeadline)) return;
    rehearsal_.began(spare_->pid(), nextNumber_++, *last);
    static_cast<void>(spare_->flush());
}

}  // namespace volcast::workers
