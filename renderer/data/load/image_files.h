#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::data::load {

/// The files of a stack of pictures, in the order of the numbers in their names: those of a folder,
/// or of the numbered series that a file belongs to, or that file alone.
///
/// Errors: kIo, kUnsupported (a folder without pictures).
Result<std::vector<std::string>> slicesOf(const std::string& path);

}  // namespace volcast::data::load
