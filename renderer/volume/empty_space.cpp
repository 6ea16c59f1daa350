#include "renderer/volume/empty_space.h"

#include <algorithm>
#include <functional>

#include "renderer/shading/shared.h"
#include "renderer/volume/block_ranges.h"

namespace volcast::volume {
namespace {

constexpr std::uint8_t kFarthest = 255;

/// Chebyshev distances from blocks to the nearest one that counts, by two passes over the grid,
/// each of which looks at the 13 neighbours that it has been at. Source: A. Rosenfeld, J. Pfaltz,
/// Distance Functions on Digital Pictures, Pattern Recognition 1(1), 1968.
class Distances {
public:
    /// Those that count are 0, others kFarthest.
    Distances(std::vector<std::uint8_t> distances, glm::ivec3 grid)
        : distances_{std::move(distances)}, grid_{grid}, before_(grid.x + 2), nearest_(grid.x) {}

    std::vector<std::uint8_t> made() {
        for (int z = 0; z < grid_.z; ++z) {
            for (int y = 0; y < grid_.y; ++y) passForward(y, z);
        }
        for (int z = grid_.z - 1; z >= 0; --z) {
            for (int y = grid_.y - 1; y >= 0; --y) passBackward(y, z);
        }
        return std::move(distances_);
    }

private:
    std::uint8_t* row(int y, int z) {
        return &distances_[(static_cast<std::size_t>(z) * grid_.y + y) * grid_.x];
    }

    void join(int y, int z) {
        if (y < 0 || z < 0 || y >= grid_.y || z >= grid_.z) return;
        const std::uint8_t* from = row(y, z);
        for (int x = 0; x < grid_.x; ++x) before_[x + 1] = std::min(before_[x + 1], from[x]);
    }

    /// The smallest of a row's neighbours in the four rows on the side that `side` (-1, 1) says.
    void lookAround(int y, int z, int side) {
        std::ranges::fill(before_, kFarthest);
        for (int beside = -1; beside <= 1; ++beside) join(y + beside, z + side);
        join(y + side, z);
        for (int x = 0; x < grid_.x; ++x) {
            nearest_[x] = std::min({before_[x], before_[x + 1], before_[x + 2]});
        }
    }

    void passForward(int y, int z) {
        lookAround(y, z, -1);
        std::uint8_t* own = row(y, z);
        std::uint8_t last = kFarthest;
        for (int x = 0; x < grid_.x; ++x) own[x] = last = nearer(own[x], nearest_[x], last);
    }

    void passBackward(int y, int z) {
        lookAround(y, z, 1);
        std::uint8_t* own = row(y, z);
        std::uint8_t last = kFarthest;
        for (int x = grid_.x - 1; x >= 0; --x) own[x] = last = nearer(own[x], nearest_[x], last);
    }

    static std::uint8_t nearer(std::uint8_t own, std::uint8_t around, std::uint8_t last) {
        const int next = std::min(around, last) + 1;
        return static_cast<std::uint8_t>(std::min<int>(own, next));
    }

    std::vector<std::uint8_t> distances_;
    glm::ivec3 grid_;
    std::vector<std::uint8_t> before_;  // With one more at both ends.
    std::vector<std::uint8_t> nearest_;
};

/// The grid coordinates between which all blocks lie that show; none: the first is above the
/// second.
std::array<glm::vec3, 2> shownBox(std::span<const std::uint8_t> shows, glm::ivec3 grid) {
    glm::ivec3 low = grid, high{-1};
    std::size_t i = 0;
    for (int z = 0; z < grid.z; ++z) {
        for (int y = 0; y < grid.y; ++y, i += static_cast<std::size_t>(grid.x)) {
            const auto row = shows.subspan(i, static_cast<std::size_t>(grid.x));
            const auto first = std::ranges::find(row, 1);
            if (first == row.end()) continue;
            const auto last = std::find(row.rbegin(), row.rend(), 1);
            low = glm::min(low, glm::ivec3(first - row.begin(), y, z));
            high = glm::max(high, glm::ivec3(row.rend() - last - 1, y, z));
        }
    }
    return {glm::vec3(kRangeBlock * low), glm::vec3(kRangeBlock * (high + 1))};
}

/// 1 where a block of any channel has a value that shows, else 0.
std::vector<std::uint8_t> showingAny(std::span<const ShownChannel> channels) {
    std::vector<std::uint8_t> any;
    for (const ShownChannel& channel : channels) {
        const ChannelRanges& known = *channel.ranges;
        std::vector<std::uint8_t> one = showingBlocks(known.ranges, channel.shown, known.overshoot);
        if (!any.empty()) std::ranges::transform(any, one, one.begin(), std::bit_or{});
        any = std::move(one);
    }
    return any;
}

}  // namespace

bool shows(const ShownValues& shown, glm::vec2 range) {
    const auto next = std::ranges::lower_bound(shown, range.x, {}, &glm::vec2::y);
    return next != shown.end() && next->x <= range.y;
}

std::vector<std::uint8_t> showingBlocks(std::span<const glm::vec2> ranges, const ShownValues& shown,
                                        float overshoot) {
    std::vector<std::uint8_t> showing(ranges.size());
    std::ranges::transform(ranges, showing.begin(), [&](glm::vec2 range) -> std::uint8_t {
        const float over = overshoot > 0.0F ? overshoot * (range.y - range.x) : 0.0F;
        return shows(shown, {range.x - over, range.y + over}) ? 1 : 0;
    });
    return showing;
}

std::vector<std::uint8_t> distancesToShowing(std::span<const std::uint8_t> shows, glm::ivec3 grid) {
    std::vector<std::uint8_t> distances(shows.size());
    std::ranges::transform(shows, distances.begin(), [](std::uint8_t own) -> std::uint8_t {
        return own != 0 ? 0 : kFarthest;
    });
    return Distances{std::move(distances), grid}.made();
}

Result<void> EmptySpace::set(gpu::Device& device, std::vector<ShownChannel> channels) {
    if (buffer_.valid() && channels == channels_) return {};
    const glm::ivec3 grid = channels.front().ranges->grid;
    const std::vector<std::uint8_t> shows = showingAny(channels);
    std::vector<std::uint8_t> apart = distancesToShowing(shows, grid);
    apart.resize((apart.size() + 3) / 4 * 4);  // Four to a word.
    const auto bytes = std::as_bytes(std::span{apart});
    if (buffer_.valid() && buffer_.bytes() == bytes.size()) {
        buffer_.update(0, bytes);
    } else {
        auto made = gpu::Buffer::create(device,
                                        {.bytes = bytes.size(),
                                         .updatable = true,
                                         .texels = gpu::TexelFormat::kR32U,
                                         .label = "empty space"},
                                        bytes);
        if (!made) return made.error();
        buffer_ = std::move(*made);
    }
    box_ = shownBox(shows, grid);
    channels_ = std::move(channels);
    return {};
}

void EmptySpace::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kEmptySpaceUnit);
}

}  // namespace volcast::volume
