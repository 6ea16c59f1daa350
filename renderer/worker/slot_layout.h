#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/scene/scene.h"

namespace volcast::worker {

/// Slots of shared memory that frames are written to. While the server copies one picture out of
/// one slot, the next is drawn into the other.
inline constexpr std::uint32_t kSlots = 2;

/// Bytes of a slot for one picture: RGBA8, then float32 RGBA where wanted.
[[nodiscard]] constexpr std::size_t slotBytes(scene::PictureSize size, bool wantFloat) noexcept {
    const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    return pixels * (wantFloat ? 4 + 4 * sizeof(float) : 4);
}

}  // namespace volcast::worker
