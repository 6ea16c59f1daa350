#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// Channels that one layer draws together at most: components of a texel.
inline constexpr std::size_t kMaxChannels = 4;

/// Those of the layer's channels that are visible.
std::vector<const ChannelMap*> shownChannels(const Layer& layer);

/// Checks number, names and maps of a layer's channels, and what they are drawn with.
///
/// Errors: kInvalidArgument (a name that is empty or doubled, a map, an interval),
/// kLimitExceeded (number), kUnsupported (a model, interval, shader or evaluator that draws one
/// channel alone), with `field` below `path`.
Result<void> validateChannels(const Layer& layer, const std::string& path);

/// The same against the data. Errors: kUnsupported (a mesh), kNotFound (no such channel).
Result<void> validateChannels(const Layer& layer, const data::DatasetSummary& summary,
                              const std::string& path);

}  // namespace volcast::scene
