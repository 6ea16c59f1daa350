#pragma once

#include <string>

#include "server/commands/accuracy_rows.h"

namespace volcast::commands {

/// Error against time as a self-contained SVG: one panel a model (and layer), both axes logarithmic
/// and the same in all panels; what nothing beats is joined by a line.
std::string plotOf(const AccuracyRun& run);

}  // namespace volcast::commands
