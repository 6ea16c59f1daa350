#include "renderer/reference/caster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace volcast::reference {
namespace {

/// The distances at which a ray is within boxes.
class BoxTest {
public:
    BoxTest(const SkewRay& ray, const Span& span, double largest) : span_{span} {
        // Far above what rounding moves a vertex by, far below any cell that counts.
        constexpr double kMargin = 1e-12;
        const glm::dvec3 size = glm::abs(ray.origin());
        const double margin = kMargin * (largest + std::max({size.x, size.y, size.z}));
        lowOrigin_ = ray.origin() + margin;
        highOrigin_ = ray.origin() - margin;
        span_.begin -= margin;
        span_.end += margin;
        for (int axis = 0; axis < 3; ++axis) {
            constexpr double kHuge = 1e200;  // Stands for 1 / 0: infinity times 0 is no number.
            const double rate = ray.direction()[axis];
            inverse_[axis] = std::abs(rate) > 1.0 / kHuge ? 1.0 / rate : kHuge;
        }
    }

    [[nodiscard]] bool meets(const glm::vec3& low, const glm::vec3& high) const {
        const glm::dvec3 a = (glm::dvec3{low} - lowOrigin_) * inverse_;
        const glm::dvec3 b = (glm::dvec3{high} - highOrigin_) * inverse_;
        const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
        return std::max(std::max(near.x, near.y), std::max(near.z, span_.begin)) <=
               std::min(std::min(far.x, far.y), std::min(far.z, span_.end));
    }

private:
    Span span_;
    glm::dvec3 lowOrigin_{0.0}, highOrigin_{0.0}, inverse_{0.0};
};

/// The piece at or after `from` that `wanted` names, among those that may tie with `distance`.
template <class Wanted>
std::size_t findNear(const std::vector<Piece>& pieces, std::size_t from, double distance,
                     const Wanted& wanted) {
    constexpr std::size_t kAlways = 8;  // Looked at whatever their distance: cells inside out.
    for (std::size_t j = from; j < pieces.size(); ++j) {
        if (wanted(pieces[j])) return j;
        if (j >= from + kAlways && pieces[j].front.distance > distance) break;
    }
    return pieces.size();
}

void moveTo(std::vector<Piece>& pieces, std::size_t to, std::size_t from) {
    const auto begin = pieces.begin();
    std::rotate(begin + static_cast<std::ptrdiff_t>(to), begin + static_cast<std::ptrdiff_t>(from),
                begin + static_cast<std::ptrdiff_t>(from) + 1);
}

}  // namespace

Caster::Caster(const data::Mesh& mesh) : mesh_{mesh} {
    const std::size_t cells = mesh.cells.size();
    std::vector<Box> boxes((cells + kFan - 1) / kFan,
                           Box{glm::vec3{INFINITY}, -glm::vec3{INFINITY}});
    for (std::size_t cell = 0; cell < cells; ++cell) {
        Box& box = boxes[cell / kFan];
        for (int corner = 0; corner < 4; ++corner) {
            const glm::vec3 point =
                mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][corner])];
            box.low = glm::min(box.low, point);
            box.high = glm::max(box.high, point);
        }
    }
    levels_.push_back(std::move(boxes));
    while (levels_.back().size() > 1) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> above((below.size() + kFan - 1) / kFan,
                               Box{glm::vec3{INFINITY}, -glm::vec3{INFINITY}});
        for (std::size_t i = 0; i < below.size(); ++i) {
            above[i / kFan].low = glm::min(above[i / kFan].low, below[i].low);
            above[i / kFan].high = glm::max(above[i / kFan].high, below[i].high);
        }
        levels_.push_back(std::move(above));
    }
    if (cells == 0) return;
    const glm::vec3 size =
        glm::max(glm::abs(levels_.back().front().low), glm::abs(levels_.back().front().high));
    largest_ = std::max({size.x, size.y, size.z});
}

void Caster::trace(const Ray& ray, const Span& span, std::span<const char> kept,
                   const FieldValues& f, const FieldValues& g, std::vector<Piece>& pieces) const {
    pieces.clear();
    if (levels_.back().empty() || !(span.begin < span.end)) return;
    const SkewRay skew{ray, mesh_.origin};
    const BoxTest test{skew, span, largest_};
    struct Node {
        std::size_t level, index;
    };
    // Each level adds at most kFan - 1 nodes that wait; 2^28 cells make 14 levels.
    std::array<Node, 64> waiting;
    std::size_t count = 0;
    waiting[count++] = {levels_.size() - 1, 0};
    while (count > 0) {
        const Node node = waiting[--count];
        const Box& box = levels_[node.level][node.index];
        if (!test.meets(box.low, box.high)) continue;
        const std::size_t first = node.index * kFan;
        if (node.level > 0) {
            const std::size_t last = std::min(first + kFan, levels_[node.level - 1].size());
            for (std::size_t i = first; i < last; ++i) waiting[count++] = {node.level - 1, i};
            continue;
        }
        for (std::size_t i = first; i < std::min(first + kFan, mesh_.cells.size()); ++i) {
            if (!kept.empty() && kept[i] == 0) continue;
            const auto piece = skew.through(mesh_, static_cast<int>(i), f, g);
            if (piece) pieces.push_back(*piece);
        }
    }
    order(pieces);
}

void order(std::vector<Piece>& pieces) {
    std::ranges::sort(pieces, [](const Piece& a, const Piece& b) {
        return a.front.distance + a.back.distance < b.front.distance + b.back.distance;
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (i > 0) {
            const Crossing& end = pieces[i - 1].back;
            const std::size_t next = findNear(pieces, i, end.distance, [&](const Piece& piece) {
                return piece.front.face == end.face;
            });
            if (next < pieces.size()) {
                moveTo(pieces, i, next);
                pieces[i].joined = true;
                continue;
            }
        }
        // A new run: pieces of length 0 may hide where it begins.
        for (std::size_t steps = i; steps < pieces.size(); ++steps) {
            const Crossing start = pieces[i].front;
            const std::size_t before =
                findNear(pieces, i + 1, start.distance,
                         [&](const Piece& piece) { return piece.back.face == start.face; });
            if (before == pieces.size()) break;
            moveTo(pieces, i, before);
        }
    }
}

}  // namespace volcast::reference
