#include "renderer/scene/channels.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/ray_models.h"

namespace volcast::scene {

namespace {

std::string pathOf(const std::string& path, std::size_t i) {
    return path + ".channels[" + std::to_string(i) + "]";
}

bool drawsSeveral(RayModel model) {
    return model == RayModel::kVolume || model == RayModel::kMip || model == RayModel::kMinip ||
           model == RayModel::kXray;
}

bool ordered(const data::Range& range) {
    return std::isfinite(range.min) && std::isfinite(range.max) && range.min <= range.max;
}

Result<void> validateCompany(const Layer& layer, const std::string& path) {
    const auto alone = [&](const char* field, const std::string& what) {
        return fail(ErrorCode::kUnsupported, path + field + ": " + what, path + field);
    };
    if (!drawsSeveral(layer.model)) {
        return alone(".channels", std::string{name(layer.model)} +
                                      " draws one channel, the layer's field; volume, mip, minip "
                                      "and xray draw several");
    }
    if (layer.interval) {
        return alone(".interval", "several channels have no values in common; give each its own");
    }
    if (!layer.shader.code.empty()) {
        return alone(".shader", "a shader reads channels itself; leave `channels` empty");
    }
    const bool slices = layer.voxelEvaluator != VoxelEvaluator::kAuto &&
                        layer.voxelEvaluator != VoxelEvaluator::kMarch;
    if (slices) return alone(".voxel_evaluator", "several channels are drawn by the march alone");
    return {};
}

}  // namespace

std::vector<const ChannelMap*> shownChannels(const Layer& layer) {
    std::vector<const ChannelMap*> shown;
    for (const ChannelMap& channel : layer.channels) {
        if (channel.visible) shown.push_back(&channel);
    }
    return shown;
}

Result<void> validateChannels(const Layer& layer, const std::string& path) {
    if (layer.channels.empty()) return {};
    if (layer.channels.size() > kMaxChannels) {
        return fail(ErrorCode::kLimitExceeded,
                    path + ".channels: " + std::to_string(layer.channels.size()) +
                        ", a layer draws at most " + std::to_string(kMaxChannels) + " together",
                    path + ".channels");
    }
    for (std::size_t i = 0; i < layer.channels.size(); ++i) {
        const ChannelMap& channel = layer.channels[i];
        const std::string field = pathOf(path, i) + ".field";
        if (channel.field.empty()) {
            return fail(ErrorCode::kInvalidArgument, field + ": names no channel", field);
        }
        const auto before = layer.channels.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::any_of(layer.channels.begin(), before,
                        [&](const ChannelMap& other) { return other.field == channel.field; })) {
            return fail(ErrorCode::kInvalidArgument,
                        field + ": \"" + channel.field + "\" is in the list already", field);
        }
        if (channel.interval && !ordered(*channel.interval)) {
            const std::string at = pathOf(path, i) + ".interval";
            return fail(ErrorCode::kInvalidArgument,
                        at + ": " + std::to_string(channel.interval->min) + " to " +
                            std::to_string(channel.interval->max) +
                            " is not a range of finite numbers, the first not above the last",
                        at);
        }
        if (const auto valid = data::validate(channel.map); !valid) {
            const std::string at = pathOf(path, i) + ".transfer_function." + valid.error().field;
            return fail(valid.error().code, at + ": " + valid.error().message, at);
        }
    }
    return validateCompany(layer, path);
}

Result<void> validateChannels(const Layer& layer, const data::DatasetSummary& summary,
                              const std::string& path) {
    if (layer.channels.empty()) return {};
    if (summary.isMesh) {
        return fail(ErrorCode::kUnsupported,
                    path + ".channels: a mesh has fields; channels are of voxels",
                    path + ".channels");
    }
    std::string names;
    for (const data::FieldSummary& field : summary.fields) {
        names += (names.empty() ? "\"" : ", \"") + field.name + "\"";
    }
    const auto missing = std::ranges::find_if(layer.channels, [&](const auto& channel) {
        return std::ranges::find(summary.fields, channel.field, &data::FieldSummary::name) ==
               summary.fields.end();
    });
    if (missing == layer.channels.end()) return {};
    const auto at = static_cast<std::size_t>(missing - layer.channels.begin());
    const std::string field = pathOf(path, at) + ".field";
    return fail(ErrorCode::kNotFound,
                field + ": there is no channel \"" + missing->field + "\", there is " + names,
                field);
}

}  // namespace volcast::scene
