#pragma once

#include <span>
#include <vector>

#include "renderer/data/mesh.h"
#include "renderer/reference/skew_ray.h"

namespace volcast::reference {

/// Finds the cells that a ray meets, by a tree of boxes; knows nothing of neighbours or boundaries.
///
/// Cells come in Morton order, so every kFan of them, and every kFan of those groups, make a box
/// that is not much too large: the tree needs no sorting and no links.
class Caster {
public:
    /// Keeps a reference to `mesh`.
    explicit Caster(const data::Mesh& mesh);

    /// All pieces of `ray` within cells that `kept` allows (empty: all; else one a cell, 0: not)
    /// whose boxes it meets in `span`, front to back; those of one run through the mesh follow its
    /// faces, even where distances tie.
    void trace(const Ray& ray, const Span& span, std::span<const char> kept, const FieldValues& f,
               const FieldValues& g, std::vector<Piece>& pieces) const;

    [[nodiscard]] const data::Mesh& mesh() const noexcept { return mesh_; }

private:
    static constexpr std::size_t kFan = 4;
    struct Box {
        glm::vec3 low, high;
    };

    const data::Mesh& mesh_;
    std::vector<std::vector<Box>> levels_;  ///< [0]: of kFan cells each; the last: one box.
    double largest_ = 0.0;                  ///< Largest coordinate, for the margin of boxes.
};

/// Puts pieces of one ray in order, as trace() promises, and fills in `joined`.
void order(std::vector<Piece>& pieces);

}  // namespace volcast::reference
