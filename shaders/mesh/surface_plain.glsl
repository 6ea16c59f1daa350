// The boundary of a mesh in one colour.
#include "mesh/surface.glsl"

void main() {
    shadeFace(layer.surfaceColour.rgb);
}
