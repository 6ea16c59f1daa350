#include "server/session/metrics_text.h"

#include "server/session/views.h"

namespace volcast::session {

std::string metricsText(Shared& shared) {
    const workers::RenderStatus render = shared.render.status();
    const ImportCounts imports = shared.catalogue.importCounts();
    return shared.metrics.text({.views = shared.views.size(),
                                .viewsToDraw = render.viewsWaiting,
                                .picturesToEncode = shared.views.picturesToEncode(),
                                .importsWaiting = imports.waiting,
                                .imports = imports.good,
                                .failedImports = imports.failed,
                                .workerStarts = render.starts,
                                .workerLosses = render.losses,
                                .workerReady = render.ready,
                                .spareReady = render.spareReady});
}

}  // namespace volcast::session
