#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "renderer/user_shader/complaint.h"

namespace volcast::user_shader {

/// The errors of a glslang log, by the user's lines and with the user's names. `userLine` is as in
/// TreeInput; errors elsewhere follow from those and are left out, unless there are no others.
std::vector<Complaint> complaintsOfLog(std::string_view log,
                                       const std::function<int(int)>& userLine);

/// `text` with the prefix taken off the user's names.
std::string withoutPrefix(std::string_view text);

}  // namespace volcast::user_shader
