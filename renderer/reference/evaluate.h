#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/reference/gather.h"
#include "renderer/reference/layer_data.h"
#include "renderer/reference/ray.h"

namespace volcast::reference {

/// Memory that rays reuse; one a thread.
struct Scratch {
    std::vector<Piece> pieces;
    std::vector<VoxelPiece> voxelPieces;
    std::vector<double> walls;
    std::vector<Part> parts;
    std::vector<double> bends;
    std::vector<std::pair<FaceName, std::size_t>> faces;
    std::uint64_t rays = 0;  ///< That were looked along.
};

/// What one ray of a scene sees.
struct Sight {
    glm::dvec4 colour{0.0};  ///< Premultiplied.
    /// Which surface and level is in front, and how often layers that end no rays are entered.
    std::uint64_t shape = 0;
    /// How often surfaces and levels are met on all of the ray: a change is a fold, seen or hidden.
    std::uint64_t folds = 0;
    double distance = std::numeric_limits<double>::infinity();  ///< Where the ray ended.
    double facing = 1.0;  ///< |cosine| of the ray to the normal there.
    std::uint64_t pieces = 0;
};

/// A scene ready for rays; read by any number of threads. Keeps references.
class Evaluator {
public:
    /// `layers`: those that are visible, in list order.
    Evaluator(const scene::Scene& scene, std::span<const LayerData> layers,
              scene::PictureSize size);

    /// The ray through `place` (pixels). Without `colours` only the shape of what it sees.
    [[nodiscard]] Sight look(const glm::dvec2& place, bool colours, Scratch& scratch) const;

    /// True where a silhouette passes between the rays through two places a pixel apart: what they
    /// see differs in shape, or in folds and by more than a smooth surface explains in distance.
    [[nodiscard]] bool apart(const Sight& a, const Sight& b) const;

    /// True where a layer's picture may jump between pixels without a silhouette.
    [[nodiscard]] bool mayJump() const noexcept { return mayJump_; }

private:
    struct Hit {
        double distance = std::numeric_limits<double>::infinity();
        double facing = 1.0;
        double level = 0.0;
        glm::dvec3 colour{0.0};
        std::size_t layer = std::numeric_limits<std::size_t>::max();
    };
    /// Where a ray ends at an opaque layer, if before `hit`.
    void meetBoundary(const LayerData& data, const Ray& ray, const glm::dvec2& place,
                      const Span& span, Scratch& scratch, Hit& hit, Sight& sight) const;
    static void meetLevel(const LayerData& data, const Ray& ray, const Span& span, Scratch& scratch,
                          Hit& hit, Sight& sight);
    /// What a layer that ends no rays adds; only its shape without `colours`.
    static glm::dvec4 through(const LayerData& data, const Ray& ray, const Span& span, bool colours,
                              Scratch& scratch, Sight& sight);

    std::span<const scene::ClipPlane> clipPlanes_;
    std::span<const LayerData> layers_;
    Lens lens_;
    bool mayJump_ = false;
};

}  // namespace volcast::reference
