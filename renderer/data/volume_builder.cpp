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

/// Index and value of the first voxel that is not finite, or nothing.
template <class T>
std::optional<std::size_t> firstNotFinite(const T* voxels, std::size_t count) {
    if constexpr (std::is_floating_point_v<T>) {
        for (std::size_t i = 0; i < count; ++i) {
            if (!std::isfinite(voxels[i])) return i;
        }
    }
    return std::nullopt;
}

template <class T>
Result<Channel> buildChannel(ChannelInput input, const Volume& volume) {
    const std::size_t count = input.voxels.size() / sizeof(T);
    // A vector<byte> is aligned for every scalar type.
    const T* voxels = reinterpret_cast<const T*>(input.voxels.data());
    if (const auto bad = firstNotFinite(voxels, count)) {
        const std::size_t i = *bad;
        const auto width = static_cast<std::size_t>(volume.size.x);
        const auto height = static_cast<std::size_t>(volume.size.y);
        return fail(ErrorCode::kInvalidArgument,
                    "channel '" + input.name + "': voxel (" + std::to_string(i % width) + ", " +
                        std::to_string(i / width % height) + ", " +
                        std::to_string(i / width / height) + ") is " +
                        std::to_string(static_cast<double>(voxels[i])) + ", not a finite number");
    }
    std::vector<glm::vec2> bricks = brickRanges(volume, 0, input.voxels);
    Range range = kEmptyRange;
    for (const glm::vec2& brick : bricks) {
        range = {.min = std::min(range.min, brick.x), .max = std::max(range.max, brick.y)};
    }
    return Channel{.name = std::move(input.name),
                   .unit = std::move(input.unit),
                   .range = range,
                   .voxels = std::move(input.voxels),
                   .bricks = std::move(bricks),
                   .coarser = {}};
}

Result<Channel> buildChannelOf(VoxelType type, ChannelInput input, const Volume& volume) {
    switch (type) {
        case VoxelType::kU8: return buildChannel<std::uint8_t>(std::move(input), volume);
        case VoxelType::kU16: return buildChannel<std::uint16_t>(std::move(input), volume);
        case VoxelType::kI16: return buildChannel<std::int16_t>(std::move(input), volume);
        case VoxelType::kF32: return buildChannel<float>(std::move(input), volume);
    }
    return fail(ErrorCode::kInvalidArgument, "volume: unknown voxel type", "type");
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
    const std::size_t expected = static_cast<std::size_t>(input.size.x) * input.size.y *
                                 input.size.z * voxelBytes(input.type);
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
        if (channel.voxels.size() != expected) {
            return fail(ErrorCode::kInvalidArgument,
                        "channel '" + channel.name + "': " + std::to_string(channel.voxels.size()) +
                            " bytes, expected " + std::to_string(expected) + " for " +
                            describe(input.size) + " voxels",
                        "channels");
        }
    }
    return {};
}

}  // namespace

Result<Volume> buildVolume(VolumeInput input, const std::function<void(double)>& pyramidProgress) {
    if (const auto checked = checkGrid(input); !checked) return checked.error();
    if (const auto checked = checkChannels(input); !checked) return checked.error();
    const auto axes = orthonormal(input.direction);
    if (!axes) {
        return fail(ErrorCode::kUnsupported,
                    "volume: the direction matrix is not orthonormal (sheared or scaled axes)",
                    "direction");
    }
    Volume volume{.size = input.size,
                  .spacing = input.spacing,
                  .origin = input.origin,
                  .direction = *axes,
                  .type = input.type,
                  .channels = {}};
    for (ChannelInput& channel : input.channels) {
        auto built = buildChannelOf(input.type, std::move(channel), volume);
        if (!built) return built.error();
        volume.channels.push_back(std::move(*built));
    }
    if (pyramidLevels(volume.size) == 0) return volume;
    const auto count = static_cast<double>(volume.channels.size());
    double done = 0.0;
    for (Channel& channel : volume.channels) {
        channel.coarser = buildPyramid(volume, channel, [&](double share) {
            if (pyramidProgress) pyramidProgress((done + share) / count);
        });
        done += 1.0;
    }
    return volume;
}

}  // namespace volcast::data
