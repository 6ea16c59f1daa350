#include "renderer/data/volume_packer.h"

#include <algorithm>

#include "renderer/data/brick_ranges.h"
#include "renderer/data/pyramid.h"

namespace volcast::data {

namespace {

std::size_t product(const glm::ivec3& v) {
    return static_cast<std::size_t>(v.x) * static_cast<std::size_t>(v.y) *
           static_cast<std::size_t>(v.z);
}

}  // namespace

Result<VolumePacker> VolumePacker::create(VolumeInput input) {
    auto volume = buildGrid(input);
    if (!volume) return volume.error();
    VolumePacker packer;
    packer.volume_ = std::move(*volume);
    const Volume& grid = packer.volume_;
    const int coarser = pyramidLevels(grid.size);
    const packed::VolumeHeader header{.spacing = grid.spacing,
                                      .origin = grid.origin,
                                      .direction = grid.direction,
                                      .size = grid.size,
                                      .type = static_cast<std::uint32_t>(grid.type),
                                      .channels = input.channels.size(),
                                      .coarserLevels = static_cast<std::uint64_t>(coarser)};
    packed::Writer& writer = packer.writer_;
    writer.addOne(packed::Tag::kVolume, header);
    for (ChannelInput& channel : input.channels) {
        ChannelSections& sections = packer.channels_.emplace_back();
        sections.name = std::move(channel.name);
        sections.unit = std::move(channel.unit);
    }
    for (ChannelSections& channel : packer.channels_) {
        channel.header = writer.reserve<packed::ChannelHeader>(packed::Tag::kChannel, 1);
        writer.addText(channel.name);
        writer.addText(channel.unit);
        for (int level = 0; level <= coarser; ++level) {
            const std::size_t bytes = product(grid.levelSize(level)) * voxelBytes(grid.type);
            channel.levels.push_back(
                {.voxels = writer.reserve<std::byte>(packed::Tag::kVoxels, bytes),
                 .bricks = writer.reserve<glm::vec2>(packed::Tag::kBricks,
                                                     product(grid.brickGrid(level)))});
        }
    }
    if (const auto opened = writer.open(packed::Kind::kVolume); !opened) return opened.error();
    return packer;
}

Result<void> VolumePacker::finishChannel(const ChannelSections& channel,
                                         const std::function<void(double)>& progress) {
    std::span<const std::byte> voxels = writer_.section<std::byte>(channel.levels[0].voxels);
    const auto withoutValue = countWithoutValue(volume_, channel.name, voxels);
    if (!withoutValue) return withoutValue.error();
    std::vector<glm::vec2> ranges = brickRanges(volume_, 0, voxels);
    const Range range = rangeOf(ranges);
    writer_.section<packed::ChannelHeader>(channel.header)[0] = {
        .range = range, .voxelsWithoutValue = *withoutValue};
    const KnownVoxels known{.range = range, .someMissing = *withoutValue > 0};
    double done = 0.0;
    for (std::size_t i = 0;; ++i) {
        const std::span bricks = writer_.section<glm::vec2>(channel.levels[i].bricks);
        std::ranges::copy(ranges, bricks.begin());
        if (i + 1 == channel.levels.size()) return {};
        const int level = static_cast<int>(i) + 1;
        const std::span coarse = writer_.section<std::byte>(channel.levels[i + 1].voxels);
        // Each level takes an eighth of the time of the one before.
        const double share = (1.0 - done) * 7.0 / 8.0;
        halve(volume_, level, known, voxels, coarse,
              [&](double part) { progress(done + part * share); });
        done += share;
        ranges = brickRanges(volume_, level, coarse);
        includeFiner(volume_, level, bricks, ranges);
        voxels = coarse;
    }
}

Result<base::FileDescriptor> VolumePacker::finish(
    const std::function<void(double)>& pyramidProgress) {
    double done = 0.0;
    for (const ChannelSections& channel : channels_) {
        const auto progress = [&](double share) {
            if (!pyramidProgress) return;
            pyramidProgress((done + share) / static_cast<double>(channels_.size()));
        };
        if (const auto finished = finishChannel(channel, progress); !finished) {
            return finished.error();
        }
        done += 1.0;
    }
    return writer_.seal();
}

}  // namespace volcast::data
