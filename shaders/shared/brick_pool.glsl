// Bricks of a volume's pyramid on the GPU, and the tree that finds them; read by C++ and by GLSL.
const int kPoolBrick = 32;    // intervals of its level that a brick covers along each axis
const int kBrickBorder = 2;   // grid points around it: tricubic slopes reach so far
const int kBrickReach = 16;   // grid intervals around a point whose range is asked for: a brick is twice
// How the bits of a voxel are a number
const int kUnsignedVoxels = 0;
const int kSignedVoxels = 1;  // 16 bits
const int kFloatVoxels = 2;
// The tree's head: x: bits of what is taken off all voxels, as it is off the values of maps.
const int kTreeHead = 0;
const int kRootNode = 1;
// A node of the tree: x: number of the first of its 8 children, x fastest; 0: it has none. y: where
// its voxels are, slot coordinates in 10 bits each, or one of the two below. z, w: bits of the
// smallest and the largest value in it.
const int kSlotBits = 10;
const int kNotLoaded = -1;    // those of a node above it stand in, with that one's range
const int kHidden = -2;       // no value in its range shows: the same, within its own range
