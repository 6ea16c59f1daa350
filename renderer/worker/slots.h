#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/memfd.h"
#include "renderer/base/result.h"
#include "renderer/scene/render.h"

namespace volcast::worker {

/// Slots of shared memory that frames are written to. While the server copies one picture out of
/// one slot, the next is drawn into the other.
inline constexpr std::uint32_t kSlots = 2;

/// Bytes of a slot for one picture: RGBA8, then float32 RGBA where wanted.
[[nodiscard]] constexpr std::size_t slotBytes(scene::PictureSize size, bool wantFloat) noexcept {
    const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    return pixels * (wantFloat ? 4 + 4 * sizeof(float) : 4);
}

/// The worker's mappings of the slots that the server made.
class Slots {
public:
    /// Uses `memory` for `slot` from now on. Errors: kInvalidArgument, kIo.
    Result<void> replace(std::uint32_t slot, const base::FileDescriptor& memory);

    /// Where a picture of `size` goes.
    ///
    /// Errors: kInvalidArgument (no such slot, or too small).
    Result<scene::FrameTarget> target(std::uint32_t slot, scene::PictureSize size, bool wantFloat);

private:
    std::array<std::optional<base::Mapping>, kSlots> slots_;
};

}  // namespace volcast::worker
