// Rays that walk from cell to cell and ask a user's code on their way, blended over what is there.
// Uses: model.
#include "mesh/walk.glsl"
#include "mesh/user_fields.glsl"
