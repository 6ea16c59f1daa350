#include "shared/bindings.glsl"
#include "shared/slice_block.glsl"

layout(std140, binding = kSliceBinding) uniform SliceUniforms {
    SliceBlock slices;
};
