// The boundary of a mesh in the colours of its values.
// Uses: classify.
#include "mesh/surface.glsl"

void main() {
    shadeFace(classify(vertexValue).rgb);
}
