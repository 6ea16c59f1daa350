#pragma once

#include "renderer/gpu/buffer.h"
#include "renderer/scene/brick_pools.h"
#include "renderer/scene/frame.h"
#include "renderer/shading/program_cache.h"

namespace volcast::scene {

/// What draws of all views share.
struct DrawContext {
    gpu::Device* device = nullptr;
    shading::ProgramCache* programs = nullptr;
    bool filterInHardware = false;  ///< See volume::filtersExactly().
    gpu::Buffer psiTable;           ///< Made when first asked for.
    UserCodes codes;
    std::uint64_t frame = 0;
    BrickPools bricks{plan::Limits{}};
};

// Bring to the GPU what a draw needs of its data and it does not have.
Result<void> prepareMesh(DrawContext& context, LayerDraw& draw);
Result<void> prepareVoxels(DrawContext& context, const Frame& frame, LayerDraw& draw);

// The layer block, the map and the opaque distances are bound by the caller.
Result<void> drawMesh(const DrawContext& context, const Frame& frame, const LayerDraw& draw,
                      const gpu::Target& target);
Result<void> drawVoxels(const DrawContext& context, const Frame& frame, const LayerDraw& draw,
                        const gpu::Target& target, Rows rows);

}  // namespace volcast::scene
