#include "renderer/scene/dataset_cache.h"

#include <algorithm>
#include <bit>

#include "renderer/scene/channels.h"
#include "renderer/scene/scale.h"

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

/// Equal for equal values on the GPU.
std::string keyOf(const FieldUse& use, int timeStep) {
    std::string key =
        std::to_string(timeStep) + "|" + std::to_string(static_cast<int>(use.scale.kind));
    // Bits, because a change in the last digit is a change.
    const auto append = [&key](float number) {
        key += "|" + std::to_string(std::bit_cast<std::uint32_t>(number));
    };
    append(use.scale.exponent);
    if (use.scale.domain) append(use.scale.domain->min);
    if (use.scale.domain) append(use.scale.domain->max);
    return key + "|" + use.field->name;
}

/// Names of the channels that a layer shows, whatever is in them.
std::vector<std::string> namesOf(const Layer& layer) {
    if (layer.channels.empty()) return {layer.field};
    std::vector<std::string> names;
    for (const ChannelMap* shown : shownChannels(layer)) names.push_back(shown->field);
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string key;
    for (const std::string& name : names) key += std::to_string(name.size()) + ":" + name;
    return key;
}

bool isTricubic(const Layer& layer) {
    return layer.sampling == Sampling::kTricubic;
}

}  // namespace

CachedDataset::CachedDataset(data::Dataset dataset, std::uint64_t generation)
    : data_{std::move(dataset)}, summary_{data::summarize(data_)}, generation_{generation} {}

Result<const MeshPart*> CachedDataset::part(gpu::Device& device, const Layer& layer,
                                            std::uint64_t frame) {
    const auto& whole = std::get<data::Mesh>(data_);
    const std::string key = partKey(layer, summary_);
    auto kept = parts_.find(key);
    if (kept == parts_.end()) {
        trim(parts_, frame);
        auto made = key.empty() ? Result<MeshPart>{MeshPart{}} : makePart(whole, layer, summary_);
        if (!made) return std::move(made).error();
        kept = parts_.emplace(key, std::move(*made)).first;
    }
    MeshPart& part = kept->second;
    part.frame = frame;
    const data::Mesh& mesh = part.mesh(whole);
    if (part.gpu == nullptr && !mesh.cells.empty()) {
        auto uploaded = mesh::MeshGpu::upload(device, mesh);
        if (!uploaded) return std::move(uploaded).error();
        part.gpu = std::move(*uploaded);
    }
    return &part;
}

Result<const mesh::FieldGpu*> CachedDataset::field(gpu::Device& device, const Layer& layer,
                                                   const MeshPart& part, const FieldUse& use,
                                                   std::uint64_t frame) {
    const auto& whole = std::get<data::Mesh>(data_);
    const data::Field& field = named(whole.fields, use.field->name);
    // Fields besides the layer's own may have fewer time steps.
    const int step = std::min(layer.timeStep, static_cast<int>(field.steps.size()) - 1);
    // Values at vertices serve every part.
    const bool gathered =
        part.restriction.has_value() && field.association != data::Association::kVertex;
    const std::string key =
        keyOf(use, step) + (gathered ? "|" + partKey(layer, summary_) : std::string{});
    auto kept = fields_.find(key);
    if (kept == fields_.end()) {
        trim(fields_, frame);
        const ScaleFunction scale{use.scale, use.field->range};
        auto uploaded =
            gathered
                ? mesh::FieldGpu::upload(
                      device, part.restriction->mesh,
                      data::restrictField(field, step, part.restriction->source.span()), 0, scale)
                : mesh::FieldGpu::upload(device, whole, field, step, scale);
        if (!uploaded) return std::move(uploaded).error();
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

Result<const volume::ChannelsGpu*> CachedDataset::channels(gpu::Device& device, const Layer& layer,
                                                           std::uint64_t frame) {
    const auto& volume = std::get<data::Volume>(data_);
    std::vector<const data::Channel*> wanted;
    const std::vector<std::string> names = namesOf(layer);
    wanted.reserve(names.size());
    for (const std::string& name : names) wanted.push_back(&named(volume.channels, name));
    const std::string key = joined(names);
    auto kept = channelSets_.find(key);
    if (kept == channelSets_.end()) {
        trim(channelSets_, frame);
        auto uploaded = volume::ChannelsGpu::upload(device, volume, wanted);
        if (!uploaded) return uploaded.error();
        kept = channelSets_.emplace(key, Kept<volume::ChannelsGpu>{std::move(*uploaded)}).first;
    }
    kept->second.frame = frame;
    return &kept->second.part;
}

std::shared_ptr<const volume::ChannelRanges> CachedDataset::ranges(const std::string& name,
                                                                   const Layer& layer) {
    const auto& volume = std::get<data::Volume>(data_);
    const data::Channel& channel = named(volume.channels, name);
    auto& known = ranges_[(isTricubic(layer) ? "cubic|" : "|") + channel.name];
    if (known == nullptr) {
        known = std::make_shared<const volume::ChannelRanges>(
            volume::channelRanges(volume, channel, isTricubic(layer)));
    }
    return known;
}

Result<const volume::RangeTable*> CachedDataset::rangeTable(gpu::Device& device, const Layer& layer,
                                                            std::uint64_t frame) {
    const std::vector<std::string> names = namesOf(layer);
    const std::string key = (isTricubic(layer) ? "cubic|" : "|") + joined(names);
    auto kept = rangeTables_.find(key);
    if (kept == rangeTables_.end()) {
        trim(rangeTables_, frame);
        std::vector<std::shared_ptr<const volume::ChannelRanges>> channels;
        channels.reserve(names.size());
        for (const std::string& name : names) channels.push_back(ranges(name, layer));
        auto uploaded = volume::RangeTable::upload(device, channels);
        if (!uploaded) return uploaded.error();
        kept = rangeTables_.emplace(key, Kept<volume::RangeTable>{std::move(*uploaded)}).first;
    }
    kept->second.frame = frame;
    return &kept->second.part;
}

Result<const volume::RawChannel*> CachedDataset::rawChannel(gpu::Device& device,
                                                            const std::string& name,
                                                            std::uint64_t frame) {
    const auto& volume = std::get<data::Volume>(data_);
    const data::Channel& channel = named(volume.channels, name);
    auto kept = rawChannels_.find(channel.name);
    if (kept == rawChannels_.end()) {
        trim(rawChannels_, frame);
        Result<volume::RawChannel> uploaded = volume::RawChannel::upload(device, volume, channel);
        if (!uploaded) return uploaded.error();
        kept = rawChannels_.emplace(channel.name, Kept<volume::RawChannel>{std::move(*uploaded)})
                   .first;
    }
    kept->second.frame = frame;
    return &kept->second.part;
}

}  // namespace volcast::scene
