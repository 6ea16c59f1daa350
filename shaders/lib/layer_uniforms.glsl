// The block of the layer that is drawn.
#include "shared/bindings.glsl"
#include "shared/layer_block.glsl"

layout(std140, binding = kLayerBinding) uniform LayerUniforms {
    LayerBlock layer;
};
