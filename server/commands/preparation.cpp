#include "server/commands/preparation.h"

#include <algorithm>
#include <chrono>

#include "server/commands/cache_folder.h"

namespace volcast::commands {

Result<workers::ImportedDataset> importFor(const SceneOptions& options, Progress& progress) {
    workers::ImportRequest request;
    request.path = options.dataset;
    request.tetgenSwitches = options.tetgenSwitches;
    if (!options.spacing.empty()) {
        request.spacing = {options.spacing[0], options.spacing[1], options.spacing[2]};
    }
    auto imported = workers::runImport(
        request, {},
        [&progress](const std::string& stage, double fraction) { progress.show(stage, fraction); });
    progress.clear();
    return imported;
}

workers::RenderSettings settingsFor(const SceneOptions& options) {
    workers::RenderSettings settings;
    settings.gpu = options.gpu;
    settings.shaderFolder = options.shaderFolder;
    settings.cacheFolder = options.cacheFolder.empty() ? userCacheFolder() : options.cacheFolder;
    settings.frameDeadline = std::chrono::milliseconds{
        static_cast<std::int64_t>(std::max(1.0, options.timeoutSeconds * 1e3))};
    settings.measureDeadline = settings.frameDeadline;
    settings.warmSpare = false;
    settings.volumeBudgetBytes = options.volumeBudgetMib << 20U;
    return settings;
}

}  // namespace volcast::commands
