#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/data/load/load.h"
#include "renderer/data/load/tetrahedralize.h"

namespace volcast::data::load {

/// Reads a surface and fills it with tetrahedra, with the request's switches.
///
/// Errors: kNotFound, kIo, kInvalidArgument, kLimitExceeded, naming the file and why.
Result<Loaded> readSurface(const Request& request, const Progress& progress);

/// Parsers of one format each; `path` is named in errors. Points that are given once a triangle
/// (STL) become one where they are equal.
///
/// Errors: kInvalidArgument, kLimitExceeded.
Result<Surface> parseOff(const std::string& path, std::string_view text);
Result<Surface> parseStl(const std::string& path, std::string_view bytes);
/// Vertex properties other than the position are left out; `warnings` says so.
Result<Surface> parsePly(const std::string& path, std::string_view bytes,
                         std::vector<std::string>& warnings);
/// .poly and .smesh (whose facets are one polygon each); `nodes` is the text of the .node file
/// beside it, for files that hold no points themselves.
Result<Surface> parsePoly(const std::string& path, std::string_view text, std::string_view nodes);

}  // namespace volcast::data::load
