#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/load/text_lines.h"
#include "renderer/data/mesh_builder.h"

namespace volcast::data::load {

/// Points as TetGen writes them.
struct NodeList {
    std::vector<glm::dvec3> points;
    std::vector<FieldInput> attributes;  ///< Vertex fields of one step.
    std::int64_t first = 0;              ///< Index of the first point in the file: 0 or 1.
};

/// Reads a list of points: "count 3 attributes markers", then "index x y z attributes marker".
///
/// A count of 0 gives an empty list (a .poly whose points lie in a .node file).
/// Errors: kInvalidArgument, kLimitExceeded, naming path and line.
Result<NodeList> readNodes(TextLines& lines);

}  // namespace volcast::data::load
