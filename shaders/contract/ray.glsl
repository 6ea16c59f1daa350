// A ray of one pixel in data space (see shared/layer_block.glsl). All distances along a ray are
// world units from its origin, which is the same point of the world for every layer.
struct Ray {
    vec3 origin;
    vec3 direction;  // length 1
};
