#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/parse.h"
#include "renderer/user_shader/tokens.h"

namespace volcast::user_shader {

/// A user's code that may be handed to a parser of GLSL: what checkText() made of it.
struct Checked {
    std::vector<Control> controls;
    std::string body;  ///< The user's names have kPrefix; every line keeps its number.
    std::vector<Complaint> complaints;  ///< None: the text is good.
    std::set<int> channels;             ///< That getDataValue() and its kin name by a number.
    bool readsAnyChannel = false;       ///< A channel is named by more than a number.
};

/// Stands before every name of the user's, so that none is one of the renderer's.
inline constexpr std::string_view kPrefix = "user";

/// Checks `code` in one pass over its text: size, words, brackets, names, `#uicontrol` lines.
Checked checkText(std::string_view code);

}  // namespace volcast::user_shader
