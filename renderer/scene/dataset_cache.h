#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/mesh/walk.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/mesh_part.h"
#include "renderer/scene/scene.h"
#include "renderer/volume/channel_ranges.h"
#include "renderer/volume/channels.h"
#include "renderer/volume/march.h"

namespace volcast::scene {

/// One dataset on the host, and those of its parts that some scene has needed on the GPU.
class CachedDataset {
public:
    CachedDataset(data::Dataset dataset, std::uint64_t generation);

    [[nodiscard]] const data::Dataset& data() const noexcept { return data_; }
    [[nodiscard]] const data::DatasetSummary& summary() const noexcept { return summary_; }
    /// Differs between datasets that had the same id one after the other.
    [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }

    /// The cells that `layer` draws, uploaded when first asked for. Needs a mesh. Pointers stay
    /// good until a call with a larger `frame`. Errors: as makePart, mesh::MeshGpu::upload.
    Result<const MeshPart*> part(gpu::Device& device, const Layer& layer, std::uint64_t frame);
    /// A field of the cells of `layer` at its time step, or the field's last, uploaded when first
    /// asked for; likewise. Errors: as mesh::FieldGpu::upload.
    Result<const mesh::FieldGpu*> field(gpu::Device& device, const Layer& layer,
                                        const MeshPart& part, const FieldUse& use,
                                        std::uint64_t frame);
    /// The channel of `layer`. Needs a volume. Errors: as volume::ChannelGpu::upload.
    Result<const volume::ChannelGpu*> channel(gpu::Device& device, const Layer& layer,
                                              std::uint64_t frame);
    /// The channel of that name as a user's code reads it; empty: the first. Likewise.
    Result<const volume::RawChannel*> rawChannel(gpu::Device& device, const std::string& name,
                                                 std::uint64_t frame);

    /// What is known of the blocks of the channel of that name (empty: the first) as `layer`
    /// samples it, found out when first asked for.
    std::shared_ptr<const volume::ChannelRanges> ranges(const std::string& name,
                                                        const Layer& layer);
    /// The same of all channels that `layer` shows, as rays read it. Errors: as
    /// volume::RangeTable::upload.
    Result<const volume::RangeTable*> rangeTable(gpu::Device& device, const Layer& layer,
                                                 std::uint64_t frame);

    /// The channels that `layer` shows together. Errors: as volume::ChannelsGpu::upload.
    Result<const volume::ChannelsGpu*> channels(gpu::Device& device, const Layer& layer,
                                                std::uint64_t frame);

private:
    template <class T>
    struct Kept {
        T part;
        std::uint64_t frame = 0;  ///< Last used in.
    };
    data::Dataset data_;
    data::DatasetSummary summary_;
    std::uint64_t generation_;
    std::map<std::string, MeshPart> parts_;                                ///< By partKey().
    std::map<std::string, Kept<std::unique_ptr<mesh::FieldGpu>>> fields_;  ///< By keyOf().
    std::map<std::string, Kept<volume::ChannelGpu>> channels_;
    std::map<std::string, Kept<volume::ChannelsGpu>> channelSets_;  ///< By their names.
    std::map<std::string, Kept<volume::RawChannel>> rawChannels_;
    // By names and how they are sampled.
    std::map<std::string, std::shared_ptr<const volume::ChannelRanges>> ranges_;
    std::map<std::string, Kept<volume::RangeTable>> rangeTables_;
};

}  // namespace volcast::scene
