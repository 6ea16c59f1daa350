// Which faces of cells are drawn; the constant kSides.
const int kNearSides = 0;  // those through which lines enter: where they leave is computed
const int kFarSides = 1;   // those through which they leave: where they enter is computed
const int kAllSides = 2;
