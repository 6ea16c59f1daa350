#pragma once

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "server/commands/scene_options.h"

namespace volcast::commands {

/// The one layer that the options describe, drawn with their ray model, else with `usual`; not yet
/// checked against the data.
///
/// Errors: kIo and kInvalidArgument naming the file or option, kNotFound naming the fields there
/// are, kUnsupported naming the integrators that serve the model.
Result<scene::Layer> layerFor(const SceneOptions& options, const data::DatasetSummary& summary,
                              scene::RayModel usual);

/// `error` of something read from `path`.
Error in(const std::string& path, const Error& error);

}  // namespace volcast::commands
