#pragma once

#include <string>
#include <string_view>

namespace volcast::data {

inline constexpr std::size_t kMaxNameBytes = 1024;  ///< Of field names and units.

/// True where `text` is UTF-8 without NUL, overlong forms and surrogates.
bool isUtf8(std::string_view text) noexcept;

/// `text` with every byte that is no UTF-8 made '?', cut to kMaxNameBytes.
std::string toUtf8(std::string text);

}  // namespace volcast::data
