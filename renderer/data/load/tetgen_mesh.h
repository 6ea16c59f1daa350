#pragma once

#include "renderer/data/load/load.h"

namespace volcast::data::load {

/// Reads a mesh that TetGen wrote: points (.node) and tetrahedra of 4 or 10 points (.ele), with
/// attributes as fields. Where there is no .ele, the Delaunay mesh of the points is made.
///
/// Errors: kNotFound, kIo, kInvalidArgument, kLimitExceeded, naming file and line.
Result<Loaded> readTetgenMesh(const Request& request, const Progress& progress);

}  // namespace volcast::data::load
