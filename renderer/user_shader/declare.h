#pragma once

#include <optional>
#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/directive.h"

namespace volcast::user_shader {

/// The control that a directive declares; nothing where it adds to `complaints`.
std::optional<Control> declare(const Directive& directive, std::vector<Complaint>& complaints);

}  // namespace volcast::user_shader
