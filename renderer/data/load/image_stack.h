#pragma once

#include <string>

#include "renderer/data/load/load.h"

namespace volcast::data::load {

/// Reads slices through OpenImageIO: a folder of TIFF or PNG files, the numbered series that a
/// file belongs to, or a TIFF file of several pages. Slices are ordered by the numbers in their
/// names; x runs along rows, y from the first row to the last, z from slice to
/// slice. Channels become the volume's channels.
///
/// Errors: kNotFound, kIo, kInvalidArgument, kUnsupported, kLimitExceeded, naming the file.
Result<Loaded> readImages(const Request& request, const Progress& progress);

}  // namespace volcast::data::load
