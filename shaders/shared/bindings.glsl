// Binding numbers, read by C++ (inside a namespace) and by GLSL.

// Uniform blocks
const int kLayerBinding = 0;
const int kMapBinding = 1;
const int kMeshBinding = 2;
const int kSliceBinding = 3;

// Texture units
const int kMapUnit = 0;
const int kOpaqueDistanceUnit = 1;
const int kVoxelUnit = 2;
const int kBrickUnit = 3;
const int kOtherChannelUnit = 4;  // voxels: the first of those that only user code reads
const int kFirstMeshUnit = 4;
const int kEmptySpaceUnit = 13;  // voxels
const int kShareUnit = 14;     // what cells or slices gave to each pixel
const int kPsiTableUnit = 15;  // the last that any GPU has in a fragment shader
