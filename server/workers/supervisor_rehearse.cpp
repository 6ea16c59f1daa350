// What the spare does while it waits: see rehearsal.h.
#include <sys/stat.h>

#include "server/workers/supervisor.h"

namespace volcast::workers {

const RenderRequest* Supervisor::toRehearse() const {
    const RenderRequest* last = views_.lastDrawn();
    if (last == nullptr || !rehearsal_.wants(spare_->pid(), *last)) return nullptr;
    std::uint64_t bytes = 0;
    for (const scene::Layer& layer : last->scene.layers) {
        const auto packed = datasets_.find(layer.dataset);
        struct stat about {};
        if (packed == datasets_.end() || ::fstat(packed->second->get(), &about) != 0) {
            return nullptr;
        }
        bytes += static_cast<std::uint64_t>(about.st_size);
    }
    return bytes <= Rehearsal::kMostBytes ? last : nullptr;
}

bool Supervisor::spareIdle() const {
    return spare_ && spare_->ready() && spare_->warm() && !rehearsal_.underWay();
}

bool Supervisor::spareReady() const {
    return spareIdle() && toRehearse() == nullptr;
}

void Supervisor::rehearse() {
    if (inFlight_ || !spareIdle()) return;
    const RenderRequest* request = toRehearse();
    if (request == nullptr) return;
    RenderRequest whole = *request;
    whole.patient = false;
    if (!spare_->render(nextNumber_, whole, settings_.frameDeadline)) return;
    rehearsal_.began(spare_->pid(), nextNumber_++, *request);
    static_cast<void>(spare_->flush());
}

}  // namespace volcast::workers
