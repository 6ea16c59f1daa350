#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boost/json.hpp>

#include "renderer/user_shader/complaint.h"

namespace volcast::user_shader {

/// One `name=value` of a directive.
struct Parameter {
    std::string name;
    boost::json::value value;
    int column = 1;       ///< Of the name.
    int valueColumn = 1;  ///< Of the value.
};

/// `#uicontrol TYPE NAME CONTROL(param=value, ...)`, as written; CONTROL defaults to TYPE.
struct Directive {
    int line = 1;
    std::string type, name, control;
    int typeColumn = 1, nameColumn = 1, controlColumn = 1;
    std::vector<Parameter> parameters;
};

/// Whether `line` is one: blanks, `#`, blanks, `uicontrol` and then no more of a word.
bool isUiControl(std::string_view line);

/// Reads a line for which isUiControl() holds; adds what is wrong with it to `complaints`, and then
/// returns what was understood before.
Directive readDirective(std::string_view text, int line, std::vector<Complaint>& complaints);

}  // namespace volcast::user_shader
