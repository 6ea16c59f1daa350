#pragma once

#include <string>
#include <string_view>

namespace volcast::user_shader {

/// `code` with comments blanked: every other byte keeps its line and column. Comments do not begin
/// within string literals, which only directives may have.
std::string withoutComments(std::string_view code);

}  // namespace volcast::user_shader
