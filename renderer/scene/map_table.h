#pragma once

#include <vector>

#include "renderer/data/transfer_function.h"
#include "renderer/gpu/buffer.h"
#include "renderer/shading/assemble.h"

namespace volcast::scene {

/// How classify/transfer_function.glsl finds a value's piece; the constant kMapSearch.
enum class MapSearch { kCompareAll = 0, kGrid = 1, kHalve = 2 };

/// A transfer function as texels; the layout is described in classify/transfer_function.glsl.
struct MapTexels {
    std::vector<glm::vec4> texels;
    MapSearch search = MapSearch::kCompareAll;
};

/// `map` must be valid.
MapTexels mapTexels(const data::TransferFunction& map);

/// One transfer function on the GPU. An edit is one upload into the same buffer while it fits.
class MapTable {
public:
    /// Uploads `map` unless it is what the table holds already.
    ///
    /// Errors: kOutOfGpuMemory; the table then stays as it was.
    Result<void> set(gpu::Device& device, const data::TransferFunction& map);

    void bind() const noexcept;
    /// What recipes that classify by this table must hold.
    [[nodiscard]] shading::Constant constant() const;

private:
    data::TransferFunction map_;
    MapSearch search_ = MapSearch::kCompareAll;
    gpu::Buffer buffer_;
};

}  // namespace volcast::scene
