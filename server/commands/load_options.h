#pragma once

#include <string>
#include <vector>

#include "server/load/report.h"

namespace CLI {
class App;
}

namespace volcast::commands {

/// All flags of `volcast load`.
struct LoadOptions {
    std::string url;         ///< Empty: a server of one's own.
    std::string dataFolder;  ///< Of that one; empty: the demo.
    std::vector<std::string> serverArguments;
    load::LoadSettings settings;
    load::Thresholds thresholds;
    bool asJson = false;
};

void addLoadOptions(CLI::App& command, LoadOptions& options);

}  // namespace volcast::commands
