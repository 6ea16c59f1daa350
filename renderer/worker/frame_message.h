#pragma once

#include <string_view>

#include "renderer/base/result.h"
#include "renderer/plan/plan.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {

/// Writes id and layers of `plan` into `message`, and reads them back.
void put(const plan::FramePlan& plan, internal::v1::Rendered* message);
plan::FramePlan planFrom(const internal::v1::Rendered& message);

/// Names of the evaluators: "mesh walk", "mesh raster", "volume march".
const char* name(plan::Evaluator evaluator) noexcept;
/// The one with that name; both ends are of one build, so that there is one.
plan::Evaluator evaluatorNamed(std::string_view name);

internal::v1::Failed toMessage(const Error& error);
/// An unknown code becomes kUnsupported.
Error errorFrom(const internal::v1::Failed& message);

}  // namespace volcast::worker
