#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"
#include "renderer/data/packed_writer.h"
#include "renderer/data/volume_builder.h"

namespace volcast::data {

/// A volume on its way from a file into its packed form, without ever being anywhere else: voxels
/// are read into the memory that is handed over, and its pyramid is built there. What it makes is
/// what pack(buildVolume()) makes, with half the memory.
class VolumePacker {
public:
    /// Makes room; `input` has names of channels, but no voxels.
    ///
    /// Errors: as buildVolume() but for voxels, kIo (no memory).
    static Result<VolumePacker> create(VolumeInput input);

    [[nodiscard]] std::size_t channels() const noexcept { return channels_.size(); }
    [[nodiscard]] const std::string& name(std::size_t channel) const {
        return channels_[channel].name;
    }
    /// To be filled: x fastest, native byte order.
    [[nodiscard]] std::span<std::byte> voxels(std::size_t channel) const {
        return writer_.section<std::byte>(channels_[channel].levels.front().voxels);
    }

    /// Checks the voxels, finds ranges, builds the pyramid, seals. `pyramidProgress` may be empty.
    ///
    /// Errors: kInvalidArgument (as countWithoutValue()), kIo.
    Result<base::FileDescriptor> finish(const std::function<void(double)>& pyramidProgress);

private:
    /// Numbers of sections.
    struct Level {
        std::size_t voxels = 0, bricks = 0;
    };
    struct ChannelSections {
        std::string name, unit;
        std::size_t header = 0;
        std::vector<Level> levels;  ///< The finest first.
    };
    VolumePacker() = default;
    Result<void> finishChannel(const ChannelSections& channel,
                               const std::function<void(double)>& progress);

    packed::Writer writer_;
    Volume volume_;  ///< Without channels.
    std::vector<ChannelSections> channels_;
};

}  // namespace volcast::data
