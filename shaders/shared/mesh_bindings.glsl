// Binding numbers of mesh passes, read by C++ (inside a namespace) and by GLSL. Texture units go on
// from kFirstMeshUnit.

const int kPositionUnit = 4;   // 3 floats a vertex, data space
const int kVertexUnit = 5;     // xyz: camera space, w: value (fields at vertices)
const int kCellUnit = 6;       // 2 texels a cell, see mesh/mesh.glsl
const int kBoundaryUnit = 7;   // 2 texels a boundary face, see mesh/mesh.glsl
const int kFieldUnit = 8;      // values as they are stored
const int kEntryUnit = 9;      // a pixel's first boundary face, or the head of its list
const int kEntryNodeUnit = 10; // nodes of all lists
const int kDensityUnit = 11;   // values of the second field as they are stored
const int kCornerUnit = 12;    // a cell's vertices, positively oriented
const int kOrderUnit = 13;     // cells by number, front to back
const int kLevelUnit = 9;      // values of levels; instead of entries
const int kLevelCellUnit = 13; // cells and the numbers of levels that they meet; instead of an order
const int kOtherFieldUnit = 11;  // the first of those that only user code reads; instead of a second field,
                                 // corners, orders, shares and the psi table
const int kMostOtherFields = 5;

// Storage blocks
const int kVertexStorage = 0;
const int kNodeStorage = 1;
const int kCountStorage = 2;
const int kPausedStorage = 3;

// Image units
const int kHeadImage = 0;

// Where a field's values sit; the constant kValuesAt.
const int kValuesAtVertices = 0;
const int kValuesAtCells = 1;
const int kValuesAtCorners = 2;
const int kValuesNowhere = 3;  // there is no such field
