#include "renderer/data/volume_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "renderer/data/brick_ranges.h"
#include "renderer/data/pyramid.h"
#include "renderer/data/text.h"

namespace volcast::data {

namespace {

constexpr Range kEmptyRange{.min = std::numeric_limits<float>::infinity(),
                            .max = -std::numeric_limits<float>::infinity()};

std::string describe(const glm::ivec3& v) {
    return std::to_string(v.x) + " x " + std::to_string(v.y) + " x " + std::to_string(v.z);
}

Result<void> checkGrid(const VolumeInput& input) {
    if (glm::any(glm::lessThan(input.size, glm::ivec3{1}))) {
        return fail(ErrorCode::kInvalidArgument,
                    "volume: size " + describe(input.size) + " has a side below 1", "size");
    }
    if (glm::any(glm::greaterThan(input.size, glm::ivec3{kMaxVolumeSide}))) {
        return fail(ErrorCode::kLimitExceeded,
                    "volume: size " + describe(input.size) + ", the limit of a side is " +
                        std::to_string(kMaxVolumeSide),
                    "size");
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!(input.spacing[axis] > 0.0) || !std::isfinite(input.spacing[axis])) {
            return fail(ErrorCode::kInvalidArgument,
                        "volume: spacing " + std::to_string(input.spacing[axis]) + " of axis " +
                            std::to_string(axis) + " is not above 0",
                        "spacing");
        }
        if (!std::isfinite(input.origin[axis])) {
            return fail(ErrorCode::kInvalidArgument, "volume: the origin is not finite", "origin");
        }
    }
    return {};
}

/// The nearest orthonormal axes by Gram-Schmidt, or nothing where they are no rotation at all.
std::optional<glm::dmat3> orthonormal(const glm::dmat3& axes) {
    constexpr double kTolerance = 1e-3;
    const glm::dmat3 product = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double expected = i == j ? 1.0 : 0.0;
            if (!(std::abs(product[i][j] - expected) <= kTolerance)) return std::nullopt;
        }
    }
    const glm::dvec3 x = glm::normalize(axes[0]);
    const glm::dvec3 y = glm::normalize(axes[1] - x * glm::dot(x, axes[1]));
    const glm::dvec3 z = glm::cross(x, y);
    return glm::dmat3{x, y, glm::dot(z, axes[2]) < 0.0 ? -z : z};
}

std::size_t channelBytes(const glm::ivec3& size, VoxelType type) {
    return static_cast<std::size_t>(size.x) * size.y * size.z * voxelBytes(type);
}

Channel buildChannel(ChannelInput input, const Volume& volume, std::uint64_t withoutValue) {
    std::vector<glm::vec2> bricks = brickRanges(volume, 0, input.voxels);
    const Range range = rangeOf(bricks);
    return Channel{.name = std::move(input.name),
                   .unit = std::move(input.unit),
                   .range = range,
                   .voxelsWithoutValue = withoutValue,
                   .voxels = std::move(input.voxels),
                   .bricks = std::move(bricks),
                   .coarser = {}};
}

Result<void> checkChannels(VolumeInput& input) {
    if (input.channels.empty()) {
        return fail(ErrorCode::kInvalidArgument, "volume: has no channel", "channels");
    }
    if (input.channels.size() > kMaxChannels) {
        return fail(ErrorCode::kLimitExceeded,
                    "volume: " + std::to_string(input.channels.size()) +
                        " channels, the limit is " + std::to_string(kMaxChannels),
                    "channels");
    }
    const std::size_t expected = channelBytes(input.size, input.type);
    if (expected > kMaxVolumeBytes) {
        return fail(ErrorCode::kLimitExceeded,
                    "volume: " + std::to_string(expected) + " bytes a channel, the limit is " +
                        std::to_string(kMaxVolumeBytes),
                    "size");
    }
    std::set<std::string> names;
    for (ChannelInput& channel : input.channels) {
        channel.name = toUtf8(std::move(channel.name));
        channel.unit = toUtf8(std::move(channel.unit));
        if (channel.name.empty() || !names.insert(channel.name).second) {
            return fail(ErrorCode::kInvalidArgument,
                        "volume: channel name '" + channel.name + "' is empty or occurs twice",
                        "channels");
        }
    }
    return {};
}

Result<void> checkBytes(const VolumeInput& input) {
    const std::size_t expected = channelBytes(input.size, input.type);
    for (const ChannelInput& channel : input.channels) {
        if (channel.voxels.size() == expected) continue;
        return fail(ErrorCode::kInvalidArgument,
                    "channel '" + channel.name + "': " + std::to_string(channel.voxels.size()) +
                        " bytes, expected " + std::to_string(expected) + " for " +
                        describe(input.size) + " voxels",
                    "channels");
    }
    return {};
}

}  // namespace

Result<Volume> buildGrid(VolumeInput& input) {
    if (const auto checked = checkGrid(input); !checked) return checked.error();
    if (const auto checked = checkChannels(input); !checked) return checked.error();
    const auto axes = orthonormal(input.direction);
    if (!axes) {
        return fail(ErrorCode::kUnsupported,
                    "volume: the direction matrix is not orthonormal (sheared or scaled axes)",
                    "direction");
    }
    return Volume{.size = input.size,
                  .spacing = input.spacing,
                  .origin = input.origin,
                  .direction = *axes,
                  .type = input.type,
                  .channels = {}};
}

Result<std::uint64_t> countWithoutValue(const Volume& volume, const std::string& channel,
                                        std::span<const std::byte> bytes) {
    if (volume.type != VoxelType::kF32) return std::uint64_t{0};
    // Voxels are aligned: they start a vector or a section of a packed dataset.
    const std::span voxels{reinterpret_cast<const float*>(bytes.data()),
                           bytes.size() / sizeof(float)};
    const auto count = static_cast<std::uint64_t>(
        std::ranges::count_if(voxels, [](float v) { return std::isnan(v); }));
    if (count == voxels.size()) {
        return fail(ErrorCode::kInvalidArgument, "channel '" + channel + "': has no value, all " +
                                                     std::to_string(count) + " voxels are NaN");
    }
    const auto bad = std::ranges::find_if(voxels, [](float v) { return std::isinf(v); });
    if (bad == voxels.end()) return count;
    const auto i = static_cast<std::size_t>(bad - voxels.begin());
    const auto width = static_cast<std::size_t>(volume.size.x);
    const auto height = static_cast<std::size_t>(volume.size.y);
    return fail(ErrorCode::kInvalidArgument,
                "channel '" + channel + "': voxel (" + std::to_string(i % width) + ", " +
                    std::to_string(i / width % height) + ", " + std::to_string(i / width / height) +
                    ") is " + std::to_string(static_cast<double>(*bad)) +
                    "; voxels are finite numbers, or NaN where there is no value");
}

Range rangeOf(std::span<const glm::vec2> bricks) {
    Range range = kEmptyRange;
    for (const glm::vec2& brick : bricks) {
        range = {.min = std::min(range.min, brick.x), .max = std::max(range.max, brick.y)};
    }
    return range;
}

Result<Volume> buildVolume(VolumeInput input, const std::function<void(double)>& pyramidProgress) {
    auto volume = buildGrid(input);
    if (!volume) return volume;
    if (const auto checked = checkBytes(input); !checked) return checked.error();
    for (ChannelInput& channel : input.channels) {
        const auto withoutValue = countWithoutValue(*volume, channel.name, channel.voxels);
        if (!withoutValue) return withoutValue.error();
        volume->channels.push_back(buildChannel(std::move(channel), *volume, *withoutValue));
    }
    if (pyramidLevels(volume->size) == 0) return volume;
    const auto count = static_cast<double>(volume->channels.size());
    double done = 0.0;
    for (Channel& channel : volume->channels) {
        channel.coarser = buildPyramid(*volume, channel, [&](double share) {
            if (pyramidProgress) pyramidProgress((done + share) / count);
        });
        done += 1.0;
    }
    return volume;
}

}  // namespace volcast::data
