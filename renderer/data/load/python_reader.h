#pragma once

#include <string>

#include "renderer/data/load/formats.h"
#include "renderer/data/load/load.h"

namespace volcast::data::load {

/// Reads a file with one of the Python readers that are built into this program.
///
/// Starts Debian's Python as a child, which may execute nothing once it runs; from then on this
/// process may not either. What the child sends is not trusted. The child dies with this process.
/// Errors: what the reader refused; kNotFound (no Python), kIo, kLimitExceeded (memory),
/// kInvalidArgument (the child died or sent nonsense).
Result<Loaded> readWithPython(const Format& format, const Request& request,
                              const Progress& progress);

}  // namespace volcast::data::load
