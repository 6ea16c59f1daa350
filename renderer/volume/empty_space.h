#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/gpu/buffer.h"
#include "renderer/volume/channel_ranges.h"

namespace volcast::volume {

/// Values that can show: closed intervals [x, y], ascending, none touching the next.
using ShownValues = std::vector<glm::vec2>;

/// The values of one channel that can show.
struct ShownChannel {
    std::shared_ptr<const ChannelRanges> ranges;
    ShownValues shown;
    friend bool operator==(const ShownChannel&, const ShownChannel&) = default;
};

/// Whether a value of `range` shows.
bool shows(const ShownValues& shown, glm::vec2 range);

/// 1 for each range that has a value which shows, else 0. `overshoot`: as in ChannelRanges.
std::vector<std::uint8_t> showingBlocks(std::span<const glm::vec2> ranges, const ShownValues& shown,
                                        float overshoot);

/// For each block how many blocks away the nearest one is that shows, along the axis where they are
/// farthest apart (Chebyshev distance); 0 where it shows itself. So all blocks that are nearer
/// along each axis show nothing. At most 255, also where there is none.
std::vector<std::uint8_t> distancesToShowing(std::span<const std::uint8_t> shows, glm::ivec3 grid);

/// The blocks where nothing shows of any of a layer's channels, on the GPU. Read by
/// shaders/volume/empty_space.glsl.
class EmptySpace {
public:
    /// Finds out anew what shows of one or more channels of one grid, unless all is as before.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<void> set(gpu::Device& device, std::vector<ShownChannel> channels);

    void bind() const noexcept;
    /// Grid coordinates of the box outside of which nothing shows, its lowest corner and its
    /// highest; nothing shows: the first is above the second.
    [[nodiscard]] const std::array<glm::vec3, 2>& box() const noexcept { return box_; }

private:
    std::vector<ShownChannel> channels_;
    std::array<glm::vec3, 2> box_{glm::vec3{0.0F}, glm::vec3{0.0F}};
    gpu::Buffer buffer_;
};

}  // namespace volcast::volume
