#pragma once

#include "renderer/user_shader/parameters.h"

namespace volcast::user_shader {

/// The control `transferFunction`, in its form with `controlPoints=[[value, "#rrggbb", opacity],
/// ..]` or in the older one with `points=[[value, r, g, b, a], ..]`, 0 to 255.
TransferFunction transferFunction(Parameters& given);

}  // namespace volcast::user_shader
