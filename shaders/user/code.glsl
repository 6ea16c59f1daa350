// A user's code with all that it may call. The files under generated/ and `shader` are no files:
// renderer/user_shader makes them.
#include "contract/user_code.glsl"
#include "user/values.glsl"
#include "generated/values.glsl"
#include "user/controls.glsl"
#include "generated/controls.glsl"
#include "shader"
#include "user/sample.glsl"
