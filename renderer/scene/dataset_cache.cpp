#include "renderer/scene/dataset_cache.h"

#include <algorithm>

namespace volcast::scene {
namespace {

// A player of time steps touches many fields: the GPU keeps this many of one dataset, those used
// last, and more only while one picture needs more.
constexpr std::size_t kMostKept = 8;

/// Drops the parts used longest ago, but none of `frame`.
template <class Map>
void trim(Map& parts, std::uint64_t frame) {
    while (parts.size() >= kMostKept) {
        const auto oldest = std::ranges::min_element(
            parts, {}, [](const auto& entry) { return entry.second.frame; });
        if (oldest->second.frame == frame) return;
        parts.erase(oldest);
    }
}

/// The item called `name`, or the first; `items` is not empty.
template <class Items>
const auto& named(const Items& items, const std::string& name) {
    const auto found =
        std::ranges::find_if(items, [&](const auto& item) { return item.name == name; });
    return found == items.end() ? items.front() : *found;
}

}  // namespace

CachedDataset::CachedDataset(data::Dataset dataset, std::uint64_t generation)
    : data_{std::move(dataset)}, summary_{data::summarize(data_)}, generation_{generation} {}

Result<const mesh::MeshGpu*> CachedDataset::mesh(gpu::Device& device) {
    if (mesh_ == nullptr) {
        Result<std::unique_ptr<mesh::MeshGpu>> uploaded =
            mesh::MeshGpu::upload(device, std::get<data::Mesh>(data_));
        if (!uploaded) return uploaded.error();
        mesh_ = std::move(*uploaded);
    }
    return mesh_.get();
}

Result<const mesh::FieldGpu*> CachedDataset::field(gpu::Device& device, const Layer& layer,
                                                   std::uint64_t frame) {
    const auto& mesh = std::get<data::Mesh>(data_);
    const data::Field& field = named(mesh.fields, layer.field);
    const FieldKey key{field.name, layer.timeStep};
    auto kept = fields_.find(key);
    if (kept == fields_.end()) {
        trim(fields_, frame);
        Result<std::unique_ptr<mesh::FieldGpu>> uploaded =
            mesh::FieldGpu::upload(device, mesh, field, layer.timeStep);
        if (!uploaded) return uploaded.error();
        kept =
            fields_.emplace(key, Kept<std::unique_ptr<mesh::FieldGpu>>{std::move(*uploaded)}).first;
    }
    kept->second.frame = frame;
    return kept->second.part.get();
}

Result<const volume::ChannelGpu*> CachedDataset::channel(gpu::Device& device, const Layer& layer,
                                                         std::uint64_t frame) {
    const auto& volume = std::get<data::Volume>(data_);
    const data::Channel& channel = named(volume.channels, layer.field);
    auto kept = channels_.find(channel.name);
    if (kept == channels_.end()) {
        trim(channels_, frame);
        Result<volume::ChannelGpu> uploaded = volume::ChannelGpu::upload(device, volume, channel);
        if (!uploaded) return uploaded.error();
        kept =
            channels_.emplace(channel.name, Kept<volume::ChannelGpu>{std::move(*uploaded)}).first;
    }
    kept->second.frame = frame;
    return &kept->second.part;
}

data::Association CachedDataset::association(const Layer& layer) const {
    const auto* mesh = std::get_if<data::Mesh>(&data_);
    if (mesh == nullptr || mesh->fields.empty()) return data::Association::kVertex;
    return named(mesh->fields, layer.field).association;
}

}  // namespace volcast::scene
