#include "renderer/volume/channels.h"

#include <cstring>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/scene/scale.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/block_ranges.h"
#include "renderer/volume/voxel_floats.h"

namespace volcast::volume {

namespace {

/// What march_channels.glsl gathers; its kGathers.
int gathersOf(scene::RayModel model) {
    switch (model) {
        case scene::RayModel::kMip: return 1;
        case scene::RayModel::kMinip: return 2;
        case scene::RayModel::kXray: return 3;
        default: return 0;
    }
}

/// One slice of a channel as rays see its values.
void sliceOf(const data::Volume& volume, const data::Channel& channel, int slice,
             std::vector<float>& floats) {
    const std::size_t count = static_cast<std::size_t>(volume.size.x) * volume.size.y;
    const std::size_t bytes = count * data::voxelBytes(volume.type);
    const auto part = channel.voxels.span().subspan(slice * bytes, bytes);
    if (volume.type == data::VoxelType::kF32) {
        floats.resize(count);
        std::memcpy(floats.data(), part.data(), bytes);
    } else {
        toFloats(volume.type, part, floats);
    }
    const scene::ScaleFunction scale{scene::Scale{}, channel.range};
    if (scale.identity()) return;
    for (float& value : floats) value = scale.ofData(value);
}

}  // namespace

Result<ChannelsGpu> ChannelsGpu::upload(gpu::Device& device, const data::Volume& volume,
                                        std::span<const data::Channel* const> channels) {
    Result<gpu::Texture3D> texture =
        gpu::Texture3D::create(device, {.size = volume.size,
                                        .format = gpu::VoxelFormat::kRgba32F,
                                        .linear = true,
                                        .label = "channels"});
    if (!texture) return texture.error();
    std::vector<float> floats;
    std::vector<glm::vec4> texels(static_cast<std::size_t>(volume.size.x) * volume.size.y,
                                  glm::vec4{0.0F});
    for (int slice = 0; slice < volume.size.z; ++slice) {
        for (std::size_t c = 0; c < channels.size(); ++c) {
            sliceOf(volume, *channels[c], slice, floats);
            for (std::size_t i = 0; i < texels.size(); ++i) {
                texels[i][static_cast<int>(c)] = floats[i];
            }
        }
        const auto sent = texture->upload(slice, 1, std::as_bytes(std::span{texels}));
        if (!sent) return sent.error();
    }
    ChannelsGpu made;
    made.voxels_ = std::move(*texture);
    return made;
}

void ChannelsGpu::bind() const noexcept {
    voxels_.bind(shading::shared::kVoxelUnit);
}

Result<void> drawChannels(const DrawInputs& inputs, const ChannelsGpu& channels) {
    std::vector<shading::Constant> constants = inputs.constants;
    constants.insert(constants.end(), {{"kGathers", gathersOf(inputs.layer->model)},
                                       {"kSampling", static_cast<int>(inputs.layer->sampling)},
                                       {"kFilterInHardware", inputs.filterInHardware},
                                       {"kEarlyStop", inputs.plan->has(plan::kEarlyStop)},
                                       {"kSkipBricks", inputs.plan->has(plan::kEmptyBricks)},
                                       {"kByDistance", inputs.emptySpace != nullptr},
                                       {"kShaded", inputs.plan->has(plan::kLight)},
                                       {"kInterval", inputs.plan->has(plan::kInterval)},
                                       {"kJitters", inputs.plan->has(plan::kJitter)},
                                       {"kMissing", inputs.plan->has(plan::kVoxelsWithoutValue)},
                                       {"kRangeBlock", kRangeBlock},
                                       {"kRangeReach", kRangeReach},
                                       {"kTricubicOvershoot", plan::kTricubicOvershoot},
                                       {"kClipPlanes", inputs.clipPlanes},
                                       {"kClipsAtStart", true},
                                       {"kMaxRaySamples", plan::kMaxRaySamples}});
    const Result<const gpu::Program*> program =
        inputs.programs->pass(shading::kFullScreenVertex, "volume/march_channels.glsl", constants);
    if (!program) return program.error();
    inputs.target->begin(gpu::PassState{.blend = gpu::Blend::kOver});
    (*program)->use();
    channels.bind();
    if (inputs.emptySpace != nullptr) inputs.emptySpace->bind();
    if (inputs.ranges != nullptr) inputs.ranges->bind();
    drawCover(inputs);
    return {};
}

}  // namespace volcast::volume
