// The boundary of a mesh in the colours of its values.
// Uses: classify.
#include "mesh/surface.glsl"

layout(location = 0) in float vertexValue;

void main() {
    shadeFace(classify(vertexValue).rgb);
}
