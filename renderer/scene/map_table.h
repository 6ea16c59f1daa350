#pragma once

#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/scene/map_texels.h"
#include "renderer/shading/assemble.h"

namespace volcast::scene {

/// A layer's maps on the GPU. An edit is one upload into the same buffer while it fits.
class MapTable {
public:
    /// Uploads `content` unless it is what the table holds already.
    ///
    /// Errors: kOutOfGpuMemory; the table then stays as it was.
    Result<void> set(gpu::Device& device, const MapContent& content);

    void bind() const noexcept;
    [[nodiscard]] std::vector<float> levels() const;
    /// What recipes that classify by this table must hold.
    [[nodiscard]] std::vector<shading::Constant> constants() const;

private:
    MapContent content_;
    MapSearch search_ = MapSearch::kCompareAll;
    MapSearch densitySearch_ = MapSearch::kCompareAll;
    int slopes_ = 0, densitySlopes_ = 0;
    gpu::Buffer buffer_;
};

}  // namespace volcast::scene
