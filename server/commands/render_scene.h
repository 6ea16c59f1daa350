#pragma once

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "server/commands/scene_options.h"

namespace volcast::commands {

/// Id under which the commands that draw know their one dataset.
inline constexpr const char* kRenderDataset = "data";

/// The scene that the options ask for, checked against the data.
///
/// Errors: kIo and kInvalidArgument naming the file, kNotFound naming the fields there are.
Result<scene::Scene> sceneFor(const SceneOptions& options, const data::DatasetSummary& summary);

}  // namespace volcast::commands
