#pragma once

#include <string_view>
#include <vector>

#include "renderer/user_shader/complaint.h"

namespace volcast::user_shader {

/// One piece of GLSL text; `text` points into what was given to tokensOf().
struct Token {
    enum class Kind { kWord, kNumber, kSymbol };
    Kind kind = Kind::kSymbol;
    std::string_view text;
    int line = 1;
    int column = 1;

    [[nodiscard]] bool is(std::string_view symbol) const { return text == symbol; }
};

/// Splits `body` in one pass. Bytes that have no place in GLSL, and directives, become complaints.
std::vector<Token> tokensOf(std::string_view body, std::vector<Complaint>& complaints);

}  // namespace volcast::user_shader
