#include "renderer/scene/validate_sampling.h"

#include <cmath>

namespace volcast::scene {
namespace {

Error bad(ErrorCode code, const std::string& field, const std::string& why) {
    return fail(code, field + ": " + why, field);
}

}  // namespace

Result<void> validateSampling(const Layer& layer, const std::string& path) {
    const std::string step = path + ".step_world", samples = path + ".depth_samples";
    if (!std::isfinite(layer.stepWorld) || layer.stepWorld < 0.0) {
        return bad(ErrorCode::kInvalidArgument, step,
                   std::to_string(layer.stepWorld) + " is not a length of 0 or more");
    }
    if (layer.depthSamples < 0) {
        return bad(ErrorCode::kInvalidArgument, samples,
                   std::to_string(layer.depthSamples) + " is negative");
    }
    if (layer.depthSamples > kMaxDepthSamples) {
        return bad(
            ErrorCode::kLimitExceeded, samples,
            std::to_string(layer.depthSamples) + ", at most " + std::to_string(kMaxDepthSamples));
    }
    if (layer.depthSamples > 0 && layer.stepWorld > 0.0) {
        return bad(ErrorCode::kInvalidArgument, samples,
                   std::to_string(layer.depthSamples) + " beside a step_world of " +
                       std::to_string(layer.stepWorld) + "; one of them says the other");
    }
    const std::string gain = path + ".gain";
    if (!std::isfinite(layer.gain)) {
        return bad(ErrorCode::kInvalidArgument, gain, "is not a finite number");
    }
    if (std::abs(layer.gain) > kMaxGain) {
        return bad(ErrorCode::kLimitExceeded, gain,
                   std::to_string(layer.gain) + ", at most " + std::to_string(kMaxGain) +
                       " to either side of 0");
    }
    return {};
}

}  // namespace volcast::scene
