#include "renderer/worker/slots.h"

#include <string>
#include <utility>

namespace volcast::worker {

Result<void> Slots::replace(std::uint32_t slot, const base::FileDescriptor& memory) {
    if (slot >= kSlots) {
        return fail(ErrorCode::kInvalidArgument, "no frame slot " + std::to_string(slot));
    }
    slots_[slot].reset();  // First, so that the old memory can go before the new is mapped.
    auto mapping = base::map(memory, true);
    if (!mapping) return std::move(mapping).error();
    slots_[slot] = *std::move(mapping);
    return {};
}

Result<scene::FrameTarget> Slots::target(std::uint32_t slot, scene::PictureSize size,
                                         bool wantFloat) {
    if (slot >= kSlots || !slots_[slot]) {
        return fail(ErrorCode::kInvalidArgument, "no frame slot " + std::to_string(slot));
    }
    const std::span<std::byte> bytes = slots_[slot]->bytes;
    const std::size_t needed = slotBytes(size, wantFloat);
    if (bytes.size() < needed) {
        return fail(ErrorCode::kInvalidArgument,
                    "frame slot " + std::to_string(slot) + " has " + std::to_string(bytes.size()) +
                        " bytes, the picture needs " + std::to_string(needed));
    }
    const std::size_t colourBytes = slotBytes(size, false);
    scene::FrameTarget target{.rgba8 = bytes.first(colourBytes), .rgba32f = {}};
    if (wantFloat) {
        auto* floats = reinterpret_cast<float*>(bytes.data() + colourBytes);
        target.rgba32f = {floats, colourBytes};  // As many floats as there are colour bytes.
    }
    return target;
}

}  // namespace volcast::worker
