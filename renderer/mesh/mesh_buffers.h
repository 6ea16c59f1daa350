#pragma once

#include <cstdint>

#include "renderer/data/dataset.h"
#include "renderer/gpu/buffer.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// What stands behind MeshGpu.
class MeshBuffers final : public MeshGpu {
public:
    gpu::Buffer positions;  ///< 3 floats a vertex, data space.
    gpu::Buffer cells;      ///< 2 texels a cell; see shaders/mesh/walk.glsl.
    gpu::Buffer boundary;   ///< 2 texels a boundary face; see shaders/mesh/mesh.glsl.
    int vertexCount = 0;
    int cellCount = 0;
    int boundaryCount = 0;
    data::Box bounds;          ///< Data space.
    double scale = 1.0;        ///< Camera space units a world unit: 1 / half the diagonal.
    std::uint64_t serial = 0;  ///< Different for every upload, so that caches can tell them apart.

    static const MeshBuffers& of(const MeshGpu& mesh) {
        return static_cast<const MeshBuffers&>(mesh);
    }
};

/// What stands behind FieldGpu.
class FieldBuffer final : public FieldGpu {
public:
    gpu::Buffer values;  ///< One float, or four a cell in the order of vertex numbers.
    data::Association association = data::Association::kVertex;
    std::uint64_t serial = 0;

    static const FieldBuffer& of(const FieldGpu& field) {
        return static_cast<const FieldBuffer&>(field);
    }
};

/// Where a field's values sit, for the constants kValuesAt and kDensityAt; null: nowhere.
int valuesAt(data::Association association);
int valuesAt(const FieldGpu* field);

}  // namespace volcast::mesh
