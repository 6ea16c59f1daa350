#pragma once

#include <string>

namespace volcast::commands {

/// From now on only warnings and errors are logged, on stderr, behind the command's name.
void logWarningsOnly(const std::string& command);

}  // namespace volcast::commands
