#pragma once

#include "renderer/data/load/load.h"

namespace volcast::data::load {

/// A plate with a round hole under tension and bending, meshed by TetGen (some 60,000 cells):
/// the stress around the hole in closed form as vertex and cell fields.
///
/// Errors: kLimitExceeded (memory).
Result<Loaded> demoMesh();

/// The electron density of a hydrogen atom's 3d state, 128^3 voxels, as float32.
Result<Loaded> demoVolume();

}  // namespace volcast::data::load
