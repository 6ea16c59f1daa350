#pragma once

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// Checks what can be checked without data: camera, maps, numbers, limits, unique layer ids.
///
/// Errors: kInvalidArgument, kLimitExceeded, with `field` as a path such as
/// "layers[1].transfer_function.points[3].value" in the names of protocol/volcast/v1/scene.proto.
Result<void> validate(const Scene& scene);

/// Checks the scene against its data: datasets and fields exist, the ray model suits them.
///
/// Errors: kNotFound, kUnsupported, kInvalidArgument, with `field` as above.
Result<void> validate(const Scene& scene, const Summaries& summaries);

/// Errors: kInvalidArgument (a side < 1), kLimitExceeded (a side > kMaxPictureSide).
Result<void> validate(PictureSize size);

}  // namespace volcast::scene
