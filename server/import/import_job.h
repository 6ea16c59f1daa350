#pragma once

#include <optional>

#include "renderer/base/result.h"
#include "renderer/data/load/load.h"
#include "renderer/worker/channel.h"
#include "renderer/worker/fault_names.h"

namespace volcast::import {

/// Imports one dataset and says all about it over `channel`: progress, then one last message,
/// `imported` with the packed data or `refused`.
///
/// Enters the sandbox before it reads anything; `fault` strikes then. Needs one thread, once a
/// process. Errors: kDeviceLost where nobody listens any more.
Result<void> runJob(const data::load::Request& request, data::load::ImageReader readImages,
                    worker::Channel& channel, std::optional<worker::Fault> fault);

/// Enters the sandbox that `request` gets and prints what it refuses; 1 where something was let
/// through that no import may do.
int tryForbidden(const data::load::Request& request);

/// main() of both import programs: reads the arguments and runs the job. Where the dataset needs
/// OpenImageIO and `readImages` is null, `volcast-import-images` beside this program takes over.
int importMain(int argc, char** argv, data::load::ImageReader readImages);

}  // namespace volcast::import
