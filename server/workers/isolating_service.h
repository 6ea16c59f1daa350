#pragma once

#include <memory>

#include "server/workers/render_service.h"

namespace volcast::workers {

/// Views that may have a worker of their own at the same time.
inline constexpr std::size_t kMaxOwnWorkers = 8;

/// A RenderService that draws each view whose scene runs code of users with a worker of its own: a
/// draw that hangs there stalls no other view, which it would within one process. All other views
/// share one service.
///
/// Code over which two workers were lost is not run again with the same states of its controls:
/// kDeviceLost at once, which names it. A view that finds
/// kMaxOwnWorkers taken fails with kLimitExceeded. The worker ends when the view is dropped or its
/// scene runs no code any more.
///
/// Errors: as RenderService::create.
Result<std::unique_ptr<RenderService>> createIsolatingService(const RenderSettings& settings,
                                                              RenderEvents events);

}  // namespace volcast::workers
