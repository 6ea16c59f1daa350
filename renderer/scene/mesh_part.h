#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/data/mesh_restrict.h"
#include "renderer/mesh/walk.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// The cells of a mesh that some layers draw: all of them, or those that markers list and that have
/// values. On the GPU once it is drawn.
struct MeshPart {
    std::optional<data::Restriction> restriction;  ///< None: the whole mesh.
    std::unique_ptr<mesh::MeshGpu> gpu;
    std::uint64_t frame = 0;  ///< Last used in.

    [[nodiscard]] const data::Mesh& mesh(const data::Mesh& whole) const {
        return restriction ? restriction->mesh : whole;
    }
};

/// Equal for layers that draw the same cells of one mesh: empty where that may be all of them.
std::string partKey(const Layer& layer, const data::DatasetSummary& summary);

/// The part of `mesh` that `layer` draws; nothing is uploaded.
///
/// Errors: as data::keptCells.
Result<MeshPart> makePart(const data::Mesh& mesh, const Layer& layer,
                          const data::DatasetSummary& summary);

}  // namespace volcast::scene
