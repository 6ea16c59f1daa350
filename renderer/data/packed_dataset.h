#pragma once

#include <functional>
#include <string>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"
#include "renderer/data/dataset.h"

namespace volcast::data {

/// Writes `dataset` into a new memfd, sealed against every change. This is how an import process
/// hands data to the server and the server to its workers: nobody copies or parses again.
///
/// Errors: kIo (no memory).
Result<base::FileDescriptor> pack(const Dataset& dataset);

/// What is known of packed bytes beforehand.
enum class Trust {
    kNone,
    kVoxelsChecked,  ///< unpack() has accepted the same sealed bytes: voxels need not be read
                     ///< again.
};

/// Maps a packed dataset; the arrays view the mapping and keep it alive.
///
/// The bytes are not trusted (an importer that a hostile file took over may have written them):
/// sizes, offsets, ids, finiteness and ranges are all checked.
/// Errors: kInvalidArgument naming what is wrong, kIo.
Result<Dataset> unpack(const base::FileDescriptor& fd, Trust trust = Trust::kNone);

}  // namespace volcast::data
