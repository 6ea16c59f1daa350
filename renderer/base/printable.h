#pragma once

#include <string>
#include <string_view>

namespace volcast::base {

/// `text` as it may stand between quotes in one line of a log: control characters, quotes and
/// backslashes become '?', and what is longer than `most` bytes is cut.
///
/// For text that others chose: a client's name, a file's name, an origin.
std::string printable(std::string_view text, std::size_t most = 200);

}  // namespace volcast::base
