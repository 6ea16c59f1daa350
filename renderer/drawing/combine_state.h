#pragma once

#include <array>
#include <cassert>

#include "renderer/gpu/target.h"
#include "renderer/scene/ray_models.h"

namespace volcast::drawing {

/// How cells or slices that are drawn one by one become a picture, for one way to combine them.
struct CombineState {
    scene::Combine combine;
    gpu::Blend blend;
    gpu::DepthTest depth;
    float neutral;  ///< In all channels of what is drawn into, to begin with.
    bool sorted;    ///< They must come front to back.
};

// 3.4e38 is what model/mip.glsl and its like begin with.
inline constexpr std::array kCombineStates{
    CombineState{scene::Combine::kNearest, gpu::Blend::kNone, gpu::DepthTest::kNearest, 0.0F,
                 false},
    CombineState{scene::Combine::kMax, gpu::Blend::kMax, gpu::DepthTest::kNone, -3.4e38F, false},
    CombineState{scene::Combine::kMin, gpu::Blend::kMin, gpu::DepthTest::kNone, 3.4e38F, false},
    CombineState{scene::Combine::kSum, gpu::Blend::kAdd, gpu::DepthTest::kNone, 0.0F, false},
    CombineState{scene::Combine::kUnder, gpu::Blend::kUnder, gpu::DepthTest::kNone, 0.0F, true}};

inline const CombineState& stateOf(scene::Combine combine) {
    const CombineState& found = kCombineStates.at(static_cast<std::size_t>(combine));
    assert(found.combine == combine);
    return found;
}

}  // namespace volcast::drawing
