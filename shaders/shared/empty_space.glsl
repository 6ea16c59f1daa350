// Words before the blocks of volume/empty_space.glsl; read by C++ and by GLSL. The first six hold bits
// of grid coordinates: of the box outside of which nothing shows, its lowest corner and its highest.
const int kEmptySpaceHead = 8;
