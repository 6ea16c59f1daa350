#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/user_shader/complaint.h"
#include "renderer/user_shader/control.h"

namespace volcast::user_shader {

/// A user's code taken apart.
struct Parsed {
    std::string body;  ///< Without comments and directives; every line keeps its number.
    std::vector<Control> controls;
    std::vector<Complaint> complaints;  ///< By line; none: all directives are good.
};

/// Finds the controls of `code`. Whether the rest of it is allowed, check() says.
Parsed parse(std::string_view code);

}  // namespace volcast::user_shader
