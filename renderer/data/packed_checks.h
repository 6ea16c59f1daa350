#pragma once

#include "renderer/base/result.h"
#include "renderer/data/mesh.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/data/volume.h"

namespace volcast::data::packed {

/// Checks all that drawing relies on: counts, ids, finite numbers (of fields: or NaN), values
/// within their range, and that neighbours name each other across a face they share. Orientation,
/// the order of vertices and `convex` are not checked: they decide what is seen, never what is
/// read.
///
/// Errors: kInvalidArgument naming the item.
Result<void> check(const Mesh& mesh);

/// Checks all that drawing relies on: sizes, bytes, axes, finite voxels, ranges, bricks. That a
/// level or a brick's range is that of the voxels beneath is not checked: it decides what is seen,
/// never what is read.
///
/// Errors: kInvalidArgument naming the item.
Result<void> check(const Volume& volume, Trust trust);

}  // namespace volcast::data::packed
