#pragma once

#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/volume.h"
#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/gpu/texture3d.h"
#include "renderer/plan/plan.h"
#include "renderer/shading/program_cache.h"
#include "renderer/volume/bricked_layer.h"
#include "renderer/volume/channel_ranges.h"
#include "renderer/volume/empty_space.h"
#include "renderer/volume/field.h"
#include "renderer/volume/raw_channel.h"
#include "renderer/volume/voxel_blocks.h"

namespace volcast::volume {

/// One channel of a volume on the GPU, exact whatever its type. Shared by all views.
class ChannelGpu {
public:
    /// Errors: kLimitExceeded (too many voxels along an axis), kOutOfGpuMemory.
    static Result<ChannelGpu> upload(gpu::Device& device, const data::Volume& volume,
                                     const data::Channel& channel);

    void bind() const noexcept;
    [[nodiscard]] VoxelTexels texels() const noexcept { return texels_; }

private:
    VoxelTexels texels_ = VoxelTexels::kTexture;
    gpu::Buffer blocks_;     // Of all but kTexture.
    gpu::Texture3D voxels_;  // Of kTexture.
};

/// True where texture() interpolates float32 voxels in full precision. GPUs commonly keep 8 bits
/// of the position between voxels, which shows as bands under a steep map.
///
/// Draws a few pixels; meant to be asked once a device.
Result<bool> filtersExactly(gpu::Device& device, shading::ProgramCache& programs);

struct DrawInputs {
    gpu::Device* device = nullptr;
    shading::ProgramCache* programs = nullptr;
    const ChannelGpu* channel = nullptr;   ///< Or these three, where the plan says so:
    const BrickedLayer* bricks = nullptr;  ///< prepare()d for this picture.
    const BrickPool* pool = nullptr;
    const EmptySpace* emptySpace = nullptr;  ///< Of the layer, where it passesOverEmptySpace().
    const RangeTable* ranges = nullptr;      ///< Of what it draws, where it readsRanges().
    const data::Volume* volume = nullptr;
    const scene::Layer* layer = nullptr;
    const plan::LayerPlan* plan = nullptr;
    int clipPlanes = 0;
    bool filterInHardware = false;  ///< Only where filtersExactly().
    /// Of lib/layer.glsl and of the classification.
    std::vector<shading::Constant> constants;
    const gpu::Target* target = nullptr;
    /// Column and row of the first pixel and size of what is drawn of the target; of all but
    /// slices.
    glm::ivec4 cover{0};
};

/// A full-screen pass over the pixels of `inputs.cover`.
void drawCover(const DrawInputs& inputs);

/// Whether a march by that plan passes over what EmptySpace knows to show nothing.
bool passesOverEmptySpace(const scene::Layer& layer, const plan::LayerPlan& plan);
/// Whether it reads a RangeTable instead: what can still raise or lower an extreme is known on the
/// way alone.
bool readsRanges(const scene::Layer& layer, const plan::LayerPlan& plan);

/// Draws one layer over what is in the target; one that is opaque where it is nearest. The layer
/// block, the map and the opaque distances are bound by the caller.
///
/// Errors: kShaderBuild.
Result<void> drawMarch(const DrawInputs& inputs);

/// The same of a layer of cross-sections.
Result<void> drawCrossSections(const DrawInputs& inputs);

/// What tells the programs of drawMarch() apart.
struct MarchTraits {
    scene::RayModel model = scene::RayModel::kVolume;
    scene::Integrator integrator = scene::Integrator::kAverage;
    scene::Sampling sampling = scene::Sampling::kTrilinear;
    VoxelTexels texels = VoxelTexels::kTexture;
    bool filterInHardware = false;  ///< Of VoxelTexels::kTexture.
    bool skipsBricks = false;
    bool byDistance = false;  ///< Of those: by EmptySpace.
    bool earlyStop = false;
    bool lit = false;     ///< Isosurfaces, at their hits.
    bool shaded = false;  ///< Volumes, at their samples.
    bool interval = false;
    bool jitters = false;  ///< Samples are not in the middle of their steps.
    bool missing = false;  ///< Some voxels have no value.
    int clipPlanes = 0;
    FieldTraits field = {};
};

/// What a draw needs besides where a user's code says what samples show.
struct UserInputs {
    std::vector<shading::TextChunk> texts;    ///< Its chunks that are no files.
    std::vector<const RawChannel*> channels;  ///< The layer's own, then the others; or of bricks.
    int iterations = 0;                       ///< Of its loops, for one sample.
};

/// Draws one layer, cross-sections too, by its code, over what is in the target. Its controls are
/// bound by the caller.
///
/// Errors: kShaderBuild.
Result<void> drawUserCode(const DrawInputs& inputs, const UserInputs& user);

/// What tells the programs of drawUserCode() apart, but for the code.
struct UserTraits {
    scene::RayModel model = scene::RayModel::kVolume;
    scene::Sampling sampling = scene::Sampling::kTrilinear;
    bool filterInHardware = false;
    bool interval = false;
    int clipPlanes = 0;
    int otherChannels = 0;  ///< None of bricks.
    int iterations = 0;
    bool missing = false;
    bool byDistance = false;  ///< Passes over empty space, by EmptySpace.
    FieldTraits field = {};
};

shading::Recipe userRecipe(const UserTraits& traits, std::vector<shading::TextChunk> texts,
                           std::vector<shading::Constant> constants);

MarchTraits traitsOf(const DrawInputs& inputs);
shading::Recipe crossSectionRecipe(const MarchTraits& traits,
                                   std::vector<shading::Constant> constants);
shading::Recipe marchRecipe(const MarchTraits& traits, std::vector<shading::Constant> constants);

}  // namespace volcast::volume
