#pragma once

#include <memory>

#include "renderer/base/result.h"
#include "renderer/gpu/target.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// The textures a view is drawn into, and the passes' targets over them.
struct Picture {
    PictureSize size{0};
    gpu::Texture2D layers;    ///< 32F: linear, premultiplied, all layers so far.
    gpu::Texture2D distance;  ///< Opaque layers: distance along the ray from its origin.
    gpu::Texture2D depth;     ///< Opaque layers: reversed depth.
    gpu::Texture2D resolved;  ///< RGBA8: what people see.
    gpu::Target transparentPass;
    gpu::Target opaquePass;  ///< Empty where the picture has no room for opaque layers.
    gpu::Target resolvePass;
    bool hasOpaque = false;

    /// Errors: kLimitExceeded, kOutOfGpuMemory.
    static Result<std::unique_ptr<Picture>> create(gpu::Device& device, PictureSize size,
                                                   bool withOpaque);
};

}  // namespace volcast::scene
