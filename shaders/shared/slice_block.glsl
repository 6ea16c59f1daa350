// The planes that cut a volume's box into slices, across the view; read by C++ (after `using
// glm::vec4;`) and by GLSL as an std140 block. Data space; "rise": how much farther away along the
// view direction, world units.
struct SliceBlock {
    vec4 corner;    // of the box: the one nearest to the eye's plane
    vec4 edges[3];  // from there, in the order of the grid's axes; w: their rise, >= 0
    vec4 planes;    // x: how far the first plane is behind where rays start; y: from one to the next; z: how far the corner is behind where rays start
};
