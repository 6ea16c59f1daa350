#pragma once

#include <string>
#include <vector>

#include "renderer/accuracy/measurement.h"
#include "renderer/base/result.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {

/// All but the request's number.
internal::v1::Measure toMessage(const accuracy::Job& job);
internal::v1::Measured toMessage(const accuracy::Measurement& measurement);

/// Errors: as sceneFrom() and scene::validate() of sizes.
Result<accuracy::Job> jobFrom(const internal::v1::Measure& message);
accuracy::Measurement measurementFrom(const internal::v1::Measured& message);
/// float16, little-endian, 2 bytes a value.
std::string halves(const std::vector<float>& values);

}  // namespace volcast::worker
