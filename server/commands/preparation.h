#pragma once

#include "server/commands/progress.h"
#include "server/commands/scene_options.h"
#include "server/workers/import_service.h"
#include "server/workers/render_service.h"

namespace volcast::commands {

/// Imports the dataset that the options name; the bar shows how far it is.
///
/// Errors: as workers::runImport.
Result<workers::ImportedDataset> importFor(const SceneOptions& options, Progress& progress);

/// One worker without a spare, with the cache of the user's own.
workers::RenderSettings settingsFor(const SceneOptions& options);

}  // namespace volcast::commands
