#include "renderer/scene/user_controls.h"

#include <algorithm>
#include <set>

#include "renderer/scene/control_states.h"
#include "renderer/scene/ray_models.h"

namespace volcast::scene {
namespace {

using user_shader::Checked;
using user_shader::Control;

std::string namesOf(const std::vector<Control>& controls) {
    std::string names;
    for (const Control& control : controls) names += (names.empty() ? "" : ", ") + control.name;
    return names.empty() ? "none" : names;
}

/// Channels that controls read by themselves.
std::optional<int> channelOf(const Control& control) {
    if (const auto* lerp = std::get_if<user_shader::InvLerp>(&control.kind)) return lerp->channel;
    const auto* map = std::get_if<user_shader::TransferFunction>(&control.kind);
    return map == nullptr ? std::nullopt : map->channel;
}

std::set<int> namedChannels(const Checked& code) {
    std::set<int> channels = code.channels;
    for (const Control& control : code.controls) {
        if (const std::optional<int> channel = channelOf(control)) channels.insert(*channel);
    }
    return channels;
}

Error unsupported(const std::string& field, const std::string& why) {
    return fail(ErrorCode::kUnsupported, field + ": " + why, field);
}

}  // namespace

bool runsUserCode(const Layer& layer) {
    return !layer.shader.code.empty();
}

user_shader::ValueType valueType(const data::DatasetSummary& summary) {
    switch (summary.voxelType) {
        case data::VoxelType::kU8: return user_shader::ValueType::kU8;
        case data::VoxelType::kU16: return user_shader::ValueType::kU16;
        case data::VoxelType::kI16: return user_shader::ValueType::kI16;
        case data::VoxelType::kF32: break;
    }
    return user_shader::ValueType::kF32;
}

Error shaderError(const std::vector<user_shader::Complaint>& complaints, const std::string& path) {
    constexpr std::size_t kMostShown = 10;
    std::string text = path + ":";
    for (std::size_t i = 0; i < std::min(complaints.size(), kMostShown); ++i) {
        text += "\nline " + std::to_string(complaints[i].line);
        if (complaints[i].column > 1) text += ", column " + std::to_string(complaints[i].column);
        text += ": " + complaints[i].message;
    }
    if (complaints.size() > kMostShown) {
        text += "\nand " + std::to_string(complaints.size() - kMostShown) + " more";
    }
    return fail(ErrorCode::kInvalidArgument, text, path);
}

Result<Checked> resolved(const UserShader& shader, const std::string& path) {
    Checked code = user_shader::checkText(shader.code);
    if (!code.complaints.empty()) return shaderError(code.complaints, path + ".code");
    std::set<std::string> seen;
    for (std::size_t i = 0; i < shader.controls.size(); ++i) {
        const ControlState& state = shader.controls[i];
        const std::string at = path + ".controls[" + std::to_string(i) + "]";
        const auto control = std::ranges::find(code.controls, state.name, &Control::name);
        if (control == code.controls.end()) {
            return fail(ErrorCode::kNotFound,
                        at + ": the code declares no control \"" + state.name + "\"; it declares " +
                            namesOf(code.controls),
                        at);
        }
        if (!seen.insert(state.name).second) {
            return fail(ErrorCode::kInvalidArgument,
                        at + ": the control \"" + state.name + "\" has a state already", at);
        }
        Result<Control> changed = withState(*control, state, at);
        if (!changed) return std::move(changed).error();
        *control = *std::move(changed);
    }
    return code;
}

Result<void> validateShader(const Layer& layer, const std::string& path) {
    const std::string at = path + ".shader";
    if (!runsUserCode(layer)) {
        if (layer.shader.controls.empty()) return {};
        return fail(ErrorCode::kInvalidArgument,
                    at + ".controls: there is no code that declares them", at + ".controls");
    }
    const bool runs = layer.model == RayModel::kVolume || layer.model == RayModel::kMip ||
                      layer.model == RayModel::kMinip || layer.model == RayModel::kCrossSections;
    if (!runs) {
        return unsupported(
            at, "code says what samples of volume, mip, minip and cross_sections show, not of " +
                    std::string{name(layer.model)});
    }
    if (layer.light) {
        return unsupported(path + ".light",
                           "light needs the gradient of a field; what code emits has none, its "
                           "colours are shown as they are");
    }
    const Result<Checked> code = resolved(layer.shader, at);
    return code ? Result<void>{} : code.error();
}

Result<void> validateShader(const Layer& layer, const data::DatasetSummary& summary,
                            const std::string& path) {
    if (!runsUserCode(layer)) return {};
    const std::string at = path + ".shader";
    if (summary.isMesh && layer.scale != Scale{}) {
        return unsupported(path + ".scale",
                           "code is given values as they are stored, and scales "
                           "them itself");
    }
    const Result<Checked> code = resolved(layer.shader, at);
    if (!code) return code.error();
    const auto count = static_cast<int>(summary.fields.size());
    const std::string noun = summary.isMesh ? "field" : "channel";
    const auto named = namedChannels(*code);
    const auto missing =
        std::ranges::find_if(named, [count](int channel) { return channel >= count; });
    if (missing != named.end()) {
        return fail(ErrorCode::kNotFound,
                    at + ": there is no " + noun + " " + std::to_string(*missing) + "; \"" +
                        layer.dataset + "\" has " + std::to_string(count) + ", from 0",
                    at);
    }
    const std::size_t others = otherChannels(*code, layer, summary).size();
    const std::size_t most = summary.isMesh ? kMaxOtherFields : kMaxOtherChannels;
    if (others > most) {
        return fail(ErrorCode::kLimitExceeded,
                    at + ": reads " + std::to_string(others + 1) + " " + noun + "s, at most " +
                        std::to_string(most + 1),
                    at);
    }
    return {};
}

bool readsOtherChannels(const Layer& layer, const data::DatasetSummary& summary) {
    if (!runsUserCode(layer)) return false;
    const Result<Checked> code = resolved(layer.shader, "shader");
    if (!code) return false;
    return !otherChannels(*code, layer, summary).empty();
}

std::vector<int> otherChannels(const Checked& code, const Layer& layer,
                               const data::DatasetSummary& summary) {
    std::set<int> channels = namedChannels(code);
    for (std::size_t i = 0; i < summary.fields.size() && code.readsAnyChannel; ++i) {
        channels.insert(static_cast<int>(i));
    }
    const auto own = std::ranges::find(summary.fields, layer.field, &data::FieldSummary::name);
    channels.erase(own == summary.fields.end() ? 0
                                               : static_cast<int>(own - summary.fields.begin()));
    return {channels.begin(), channels.end()};
}

}  // namespace volcast::scene
