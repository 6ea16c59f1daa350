#include "renderer/volume/brick_tree.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "renderer/shading/shared.h"

namespace volcast::volume {

namespace {

constexpr int kSide = shading::shared::kPoolBrick;
constexpr int kNowhere = -1;  // Level of nodes that lie beyond the volume.

struct Box {
    glm::dvec3 low;
    glm::dvec3 high;
};

double at(const glm::dvec4& function, const glm::dvec3& point) {
    return glm::dot(glm::dvec3(function), point) + function.w;
}

/// Largest value of a linear function in a box.
double largest(const glm::dvec4& function, const Box& box) {
    const glm::dvec3 slope{function};
    return at(function, glm::mix(box.low, box.high, glm::greaterThan(slope, glm::dvec3{0.0})));
}

double smallest(const glm::dvec4& function, const Box& box) {
    return -largest(-function, box);
}

class Chooser {
public:
    Chooser(const data::Volume& volume, const data::Channel& channel, const BrickView& view,
            std::size_t capacity)
        : volume_{volume}, channel_{channel}, view_{view}, capacity_{capacity} {}

    BrickTree choose() {
        tree_.nodes.push_back(made({.level = volume_.coarserLevels(), .place = {0, 0, 0}}));
        enqueue(0);
        tree_.nodes.front().need = Need::kNeeded;  // It stands in for all that is left out.
        needed_ = 1;
        while (!waiting_.empty()) {
            const int node = std::get<2>(waiting_.top());
            waiting_.pop();
            if (!refine(node)) break;
        }
        sum();
        return std::move(tree_);
    }

private:
    /// Nodes to refine: coarse first, then near.
    using Entry = std::tuple<int, double, int>;

    [[nodiscard]] Box boxOf(const Brick& brick) const {
        const glm::dvec3 last{volume_.size - 1};
        const auto side = static_cast<double>(kSide << brick.level);
        return {.low = glm::min(side * glm::dvec3(brick.place), last),
                .high = glm::min(side * (glm::dvec3(brick.place) + 1.0), last)};
    }

    /// Of its own level's bricks of ranges, two along each axis, or four where interpolation
    /// reaches around.
    [[nodiscard]] glm::vec2 rangeOf(const Brick& brick) const {
        constexpr int kParts = kSide / data::Volume::kBrickSize;
        const auto& ranges =
            brick.level == 0 ? channel_.bricks
                             : channel_.coarser[static_cast<std::size_t>(brick.level) - 1].bricks;
        const glm::ivec3 grid = volume_.brickGrid(brick.level);
        const int around = view_.reachesAround ? 1 : 0;
        const glm::ivec3 first = glm::max(kParts * brick.place - around, 0);
        const glm::ivec3 last = glm::min(kParts * (brick.place + 1) - 1 + around, grid - 1);
        glm::vec2 range =
            ranges[(static_cast<std::size_t>(first.z) * grid.y + first.y) * grid.x + first.x];
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) {
                    const glm::vec2 part =
                        ranges[(static_cast<std::size_t>(z) * grid.y + y) * grid.x + x];
                    range = {std::min(range.x, part.x), std::max(range.y, part.y)};
                }
            }
        }
        if (range.x > range.y) return range;
        const auto over = static_cast<float>(view_.overshoot) * (range.y - range.x);
        return {range.x - over, range.y + over};
    }

    [[nodiscard]] bool isOutside(const Box& box) const {
        if (view_.sections && !glm::any(glm::lessThanEqual(box.low, *view_.sections) &&
                                        glm::greaterThanEqual(box.high, *view_.sections))) {
            return true;
        }
        return std::ranges::any_of(
            view_.planes, [&](const glm::dvec4& plane) { return largest(plane, box) < 0.0; });
    }

    [[nodiscard]] BrickNode made(const Brick& brick) const {
        BrickNode node{.brick = brick, .range = rangeOf(brick)};
        const Box box = boxOf(brick);
        node.nearest = std::max(smallest(view_.depth, box), 0.0);
        const glm::dvec3 centre = 0.5 * (box.low + box.high);
        const double seen = view_.perspective ? std::max(at(view_.depth, centre), 1e-300) : 1.0;
        node.fromMiddle =
            glm::length(glm::dvec2(at(view_.right, centre), at(view_.up, centre)) / seen);
        if (isOutside(box)) {
            node.need = Need::kOutside;
        } else if (node.range.x > node.range.y || (view_.shows && !view_.shows(node.range))) {
            node.need = Need::kHidden;
        }
        return node;
    }

    [[nodiscard]] bool wantsFiner(const BrickNode& node) const {
        if (node.need != Need::kNeeded || node.brick.level == 0) return false;
        const double pixel = view_.footprint * (view_.perspective ? node.nearest : 1.0);
        const double finerVoxel =
            view_.voxelWorld * static_cast<double>(1 << (node.brick.level - 1));
        return finerVoxel >= std::max(pixel, view_.stepWorld);
    }

    void enqueue(int node) {
        const BrickNode& one = tree_.nodes[static_cast<std::size_t>(node)];
        if (wantsFiner(one)) waiting_.emplace(one.brick.level, -one.nearest, node);
    }

    /// False where there is no room for the node's children.
    bool refine(int parent) {
        const Brick coarse = tree_.nodes[static_cast<std::size_t>(parent)].brick;
        std::vector<BrickNode> children;
        const glm::ivec3 grid = (volume_.levelSize(coarse.level - 1) - 2) / kSide + 1;
        for (int child = 0; child < 8; ++child) {
            const glm::ivec3 place =
                2 * coarse.place + glm::ivec3{child & 1, child >> 1 & 1, child >> 2};
            const Brick brick{.level = coarse.level - 1, .place = place};
            // Those that lie beyond the volume are there so that the others are where they belong.
            const bool there = glm::all(glm::lessThan(place, glm::max(grid, glm::ivec3{1})));
            children.push_back(
                there ? made(brick)
                      : BrickNode{.brick = {.level = kNowhere}, .need = Need::kOutside});
        }
        const auto needed =
            static_cast<std::size_t>(std::ranges::count(children, Need::kNeeded, &BrickNode::need));
        if (needed_ + needed > capacity_) {
            tree_.limited = true;
            return false;
        }
        needed_ += needed;
        const auto first = static_cast<int>(tree_.nodes.size());
        tree_.nodes[static_cast<std::size_t>(parent)].firstChild = first;
        tree_.nodes.insert(tree_.nodes.end(), children.begin(), children.end());
        for (int child = 0; child < 8; ++child) enqueue(first + child);
        return true;
    }

    void sum() {
        tree_.finest = volume_.coarserLevels();
        tree_.coarsest = 0;
        for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
            const BrickNode& node = tree_.nodes[i];
            if (node.brick.level == kNowhere) continue;
            if (node.need == Need::kHidden) ++tree_.hidden;
            if (node.need == Need::kOutside) ++tree_.outside;
            if (node.need != Need::kNeeded) continue;
            tree_.order.push_back(static_cast<int>(i));
            if (node.firstChild != 0) continue;
            tree_.finest = std::min(tree_.finest, node.brick.level);
            tree_.coarsest = std::max(tree_.coarsest, node.brick.level);
        }
        std::ranges::stable_sort(tree_.order, {}, [this](int i) {
            const BrickNode& node = tree_.nodes[static_cast<std::size_t>(i)];
            return std::pair{-node.brick.level, node.fromMiddle};
        });
    }

    const data::Volume& volume_;
    const data::Channel& channel_;
    const BrickView& view_;
    std::size_t capacity_;
    std::size_t needed_ = 0;
    BrickTree tree_;
    std::priority_queue<Entry> waiting_;
};

}  // namespace

BrickTree chooseBricks(const data::Volume& volume, const data::Channel& channel,
                       const BrickView& view, std::size_t capacity) {
    return Chooser{volume, channel, view, capacity}.choose();
}

}  // namespace volcast::volume
