#pragma once

#include <string>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

inline constexpr int kMaxDepthSamples = 16'384;
inline constexpr int kUsualDepthSamples = 64;  ///< Of those who count samples and give no number.
inline constexpr float kMaxGain = 10.0F;

/// How voxels of `layer`, named `path`, are sampled: step or number of samples, gain.
///
/// Errors: kInvalidArgument (not a number of its range, both a step and a number of samples),
/// kLimitExceeded (too many samples, too much gain).
Result<void> validateSampling(const Layer& layer, const std::string& path);

}  // namespace volcast::scene
