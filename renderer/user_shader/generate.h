#pragma once

#include <string>
#include <vector>

#include "renderer/user_shader/control.h"

namespace volcast::user_shader {

/// How a user's code sees the data's numbers.
enum class ValueType { kU8, kU16, kI16, kF32 };

/// All values of the type, or 0 to 1 for floating point: the default range of invlerp.
Interval fullRange(ValueType type);

/// Names of the chunks that user/code.glsl includes and that are no files.
inline constexpr const char* kValuesChunk = "generated/values.glsl";
inline constexpr const char* kControlsChunk = "generated/controls.glsl";
inline constexpr const char* kBodyChunk = "shader";

/// The text of kValuesChunk: how the code reads data of `type`, and whether rays gather what it
/// emits.
std::string valuesText(ValueType type, bool volumeRendering);

/// The text of kControlsChunk: the controls as they are now, and slotOf() for `others`, the
/// channels besides the layer's own, in the order of their slots from 1.
std::string controlsText(const std::vector<Control>& controls, const std::vector<int>& others,
                         ValueType type);

}  // namespace volcast::user_shader
