#pragma once

#include <cstdint>
#include <string>

#include "renderer/base/result.h"

namespace volcast::data::load {

/// The whole content of a plain file.
///
/// Errors: kNotFound, kIo (permission, a read that fails), kInvalidArgument (empty, or no plain
/// file), kLimitExceeded (longer than `maxBytes`); all name the path.
Result<std::string> readFile(const std::string& path, std::uint64_t maxBytes);

/// True where `path` can be found, whatever it is.
bool exists(const std::string& path);

/// `path` with the suffix after its last dot replaced: ("a/b.node", ".ele") is "a/b.ele".
std::string withSuffix(const std::string& path, const std::string& suffix);

}  // namespace volcast::data::load
