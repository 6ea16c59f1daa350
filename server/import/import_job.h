#pragma once

#include "renderer/base/result.h"
#include "renderer/data/load/load.h"
#include "renderer/worker/channel.h"

namespace volcast::import {

/// Imports one dataset and says all about it over `channel`: progress, then one last message,
/// `imported` with the packed data or `refused`.
///
/// Enters the sandbox before it reads anything. Needs one thread, once a process.
/// Errors: kDeviceLost where nobody listens any more.
Result<void> runJob(const data::load::Request& request, worker::Channel& channel);

}  // namespace volcast::import
