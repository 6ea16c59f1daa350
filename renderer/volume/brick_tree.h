#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::volume {

/// One brick of the pool: kPoolBrick^3 intervals of a level.
struct Brick {
    int level = 0;
    glm::ivec3 place{0};  ///< It starts at grid point kPoolBrick * place of its level.
    friend bool operator==(const Brick&, const Brick&) = default;
};

/// How a picture samples a volume; all of it in grid coordinates of level 0.
struct BrickView {
    std::vector<glm::dvec4> planes;  ///< Seen where dot(xyz, point) + w >= 0 for all.
    /// Planes across the axes, NaN for none: seen where a point is on one of them. None: no such
    /// planes, but rays.
    std::optional<glm::dvec3> sections = {};
    glm::dvec4 depth{0.0};  ///< World units: dot(xyz, point) + w.
    glm::dvec4 right{0.0};  ///< Likewise, to the right of the picture's middle.
    glm::dvec4 up{0.0};
    double footprint = 0.0;      ///< World units across a pixel: at depth 1, or anywhere.
    bool perspective = true;     ///< The footprint grows with depth.
    double stepWorld = 0.0;      ///< Between samples on a ray.
    double voxelWorld = 0.0;     ///< Longest side of a voxel of level 0.
    double overshoot = 0.0;      ///< How far interpolation leaves the voxels' range, of it.
    bool reachesAround = false;  ///< It reads voxels beyond the cell it is in.
    /// Whether any value in (min, max), min <= max, can show; empty: all do.
    std::function<bool(glm::vec2)> shows = {};
};

enum class Need {
    kNeeded,
    kHidden,   ///< No value in its range shows, or it has none.
    kOutside,  ///< No ray of the picture gets there.
};

struct BrickNode {
    Brick brick;
    /// Of everything interpolation may yield in it, at its level or finer; (infinity, -infinity)
    /// where no voxel has a value.
    glm::vec2 range{0.0F};
    int firstChild = 0;  ///< Eight in a row; 0: none.
    Need need = Need::kNeeded;
    double nearest = 0.0;     ///< Depth of its nearest point, at least 0.
    double fromMiddle = 0.0;  ///< Of its centre from the picture's middle, as seen.
};

/// The bricks that a picture needs, the root first. Those with children are drawn until these are
/// there.
struct BrickTree {
    std::vector<BrickNode> nodes;
    std::vector<int> order;   ///< Needed nodes as they should be loaded: coarse first, then by
                              ///< their distance from the picture's middle.
    std::size_t hidden = 0;   ///< Nodes of Need::kHidden, of whatever level.
    std::size_t outside = 0;  ///< The same, Need::kOutside.
    int finest = 0;           ///< Levels of needed nodes without children.
    int coarsest = 0;
    bool limited = false;  ///< Finer bricks are asked for, but there was no room.
};

/// Chooses, for each part of the volume, the finest level whose voxels are no finer than the
/// sampling there, which is the larger of the step and of a pixel's width: a brick is replaced by
/// those of the next level while these do not go below the sampling at its nearest point. There is
/// room for `capacity` bricks (at least 1): they are replaced level by level, the nearest first.
///
/// `volume` has a pyramid that ends in one brick, `channel` is one of its channels.
BrickTree chooseBricks(const data::Volume& volume, const data::Channel& channel,
                       const BrickView& view, std::size_t capacity);

}  // namespace volcast::volume
