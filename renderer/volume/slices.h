#pragma once

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/canvas.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

/// What slices of one layer keep between pictures: where their shares are blended.
class SlicesState {
public:
    /// Makes room for pictures of `size`.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<void> fit(gpu::Device& device, glm::ivec2 size) {
        return shares_.fit(device, size, "shares of slices");
    }
    Result<void> send(gpu::Device& device, const shading::shared::SliceBlock& block);

    [[nodiscard]] const gpu::Target& target() const noexcept { return shares_.target(); }
    void bindBlock() const noexcept { block_.bindUniform(shading::shared::kSliceBinding); }
    void bindShares() const noexcept { shares_.bind(shading::shared::kShareUnit); }

private:
    gpu::Canvas shares_;
    gpu::Buffer block_;
};

/// Where slices of a volume are, as a camera sees it.
struct SlicePlanes {
    int count = 0;  ///< 0: the volume is behind the eye.
    shading::shared::SliceBlock block{};
};

/// `start`: depth at which rays start; `step`: at most so far from one plane to the next, world
/// units.
SlicePlanes slicePlanes(const data::Volume& volume, const scene::Camera& camera, double start,
                        double step);

/// Draws one layer as polygons across the view, blended front to back: what the march does for each
/// ray at once, here slice by slice for all of them. Samples are where planes are, not where rays
/// begin, so that a ray's first and last piece may reach up to half a step out of the box or leave
/// as much of it out.
///
/// Errors: kShaderBuild, kOutOfGpuMemory.
Result<void> drawSlices(const DrawInputs& inputs, const data::Volume& volume,
                        const scene::Camera& camera, double start, glm::ivec2 size,
                        SlicesState& state);

/// The recipes of its two passes, with those of marchRecipe() in common.
shading::Recipe sliceRecipe(const MarchTraits& traits, bool instances,
                            std::vector<shading::Constant> constants);

inline constexpr const char* kSliceVertex = "volume/slices.vert.glsl";

}  // namespace volcast::volume
