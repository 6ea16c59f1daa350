#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/tokens.h"

namespace volcast::user_shader {

/// What the user's code declares that may stand before a `(`.
struct Declared {
    std::set<std::string_view> functions;
    std::set<std::string_view> structs;
};

/// Finds them, and complains of names that are taken and of a missing main().
Declared declaredBy(const std::vector<Token>& tokens, std::vector<Complaint>& complaints);

/// Complains of words that may not be used where they are, and of calls of nothing.
void checkWords(const std::vector<Token>& tokens, const Declared& declared,
                const std::vector<Control>& controls, std::vector<Complaint>& complaints);

/// Complains of controls whose name has a meaning already.
void checkControlNames(const std::vector<Control>& controls, std::vector<Complaint>& complaints);

}  // namespace volcast::user_shader
