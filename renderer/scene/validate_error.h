#pragma once

#include <string>

#include "renderer/base/result.h"

/// What the checks of scenes say alike.
namespace volcast::scene {

inline std::string pathOf(std::size_t layer) {
    return "layers[" + std::to_string(layer) + "]";
}

inline Error invalid(const std::string& field, const std::string& why) {
    return fail(ErrorCode::kInvalidArgument, field + ": " + why, field);
}

}  // namespace volcast::scene
