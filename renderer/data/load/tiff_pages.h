#pragma once

#include <string>

#include "renderer/base/result.h"

namespace volcast::data::load {

/// Pages that a TIFF file says it has, found by following its directories.
///
/// libtiff, and so OpenImageIO, takes a chain that is broken (in a file that was cut off) for one
/// that ends. Source: TIFF 6.0, section 2, and the BigTIFF design.
/// Errors: kInvalidArgument naming path and page; kLimitExceeded for more than `mostPages`, which
/// directories that lead back to one before always are; kIo.
Result<int> tiffPages(const std::string& path, int mostPages);

}  // namespace volcast::data::load
