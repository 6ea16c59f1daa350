#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/memfd.h"
#include "renderer/base/result.h"
#include "renderer/scene/render.h"
#include "renderer/worker/slot_layout.h"

namespace volcast::worker {

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
