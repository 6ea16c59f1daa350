// When a ray is finished: what lies behind changes no channel by more than a 16-bit step.
const float kFinishedOpacity = 1.0 - 1.0e-6;
const float kFinishedDepth = 13.8155;  // 1 - exp(-kFinishedDepth) = kFinishedOpacity
