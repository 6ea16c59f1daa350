#include "renderer/data/mesh_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace volcast::data {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A cell that has a volume, on its way to its final form.
struct Draft {
    glm::ivec4 ids{0};
    std::array<std::uint8_t, 4> corners{0, 1, 2, 3};
    std::uint32_t source = 0;
    std::uint64_t key = 0;
    bool positive = true;
};

/// Spreads the lowest 21 bits to every third bit.
std::uint64_t spread(std::uint64_t bits) {
    bits &= 0x1FFFFF;
    bits = (bits | bits << 32) & 0x1F00000000FFFF;
    bits = (bits | bits << 16) & 0x1F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    return bits;
}

/// Morton codes over a cube around the mesh.
class Morton {
public:
    Morton(const glm::dvec3& low, const glm::dvec3& high) : low_{low} {
        const glm::dvec3 extent = high - low;
        const double widest = std::max({extent.x, extent.y, extent.z});
        constexpr double kCells = 2097151.0;
        scale_ = widest > 0.0 ? kCells / widest : 0.0;
    }
    [[nodiscard]] std::uint64_t operator()(const glm::dvec3& point) const {
        const glm::dvec3 p = glm::max((point - low_) * scale_, glm::dvec3{0.0});
        return spread(static_cast<std::uint64_t>(p.x)) |
               spread(static_cast<std::uint64_t>(p.y)) << 1 |
               spread(static_cast<std::uint64_t>(p.z)) << 2;
    }

private:
    glm::dvec3 low_;
    double scale_ = 0.0;
};

/// Does orderMesh()'s work, one step a function, in the order they stand here.
class Ordering {
public:
    explicit Ordering(const MeshInput& input) : input_{input} {}

    void keepCellsWithVolume();
    bool rebase();
    void joinVertices();
    void nameJoinedVertices();
    void sortCells();
    void compactVertices();

    [[nodiscard]] bool empty() const { return drafts_.empty(); }
    OrderedMesh take() { return std::move(out_); }

private:
    [[nodiscard]] glm::dvec3 exact(std::uint32_t point) const {
        return input_.points[point] - out_.origin;
    }
    [[nodiscard]] glm::vec3 rounded(std::uint32_t point) const { return glm::vec3{exact(point)}; }
    [[nodiscard]] int compareValues(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] int comparePlaces(std::uint32_t a, std::uint32_t b) const;

    const MeshInput& input_;
    OrderedMesh out_;
    std::vector<Draft> drafts_;
    glm::dvec3 low_{0.0}, high_{0.0};    ///< Of the used points, relative to the origin.
    std::vector<std::uint32_t> joined_;  ///< Of each point: its place in `places_`, or kNone.
    std::vector<std::uint32_t> places_;  ///< One point of each joined vertex, Morton order.
};

void Ordering::keepCellsWithVolume() {
    drafts_.reserve(input_.cells.size());
    for (std::size_t t = 0; t < input_.cells.size(); ++t) {
        const auto& c = input_.cells[t];
        const auto at = [&](int i) { return input_.points[static_cast<std::size_t>(c[i])]; };
        const int sign = orientation(at(0), at(1), at(2), at(3));
        if (sign == 0) {
            ++out_.cellsWithoutVolume;
            continue;
        }
        drafts_.push_back({.ids = glm::ivec4{c[0], c[1], c[2], c[3]},
                           .source = static_cast<std::uint32_t>(t),
                           .positive = sign > 0});
    }
}

bool Ordering::rebase() {
    joined_.assign(input_.points.size(), kNone);
    low_ = glm::dvec3{std::numeric_limits<double>::max()};
    high_ = -low_;
    for (const Draft& draft : drafts_) {
        for (int i = 0; i < 4; ++i) {
            const auto id = static_cast<std::size_t>(draft.ids[i]);
            if (joined_[id] != kNone) continue;
            joined_[id] = 0;
            low_ = glm::min(low_, input_.points[id]);
            high_ = glm::max(high_, input_.points[id]);
        }
    }
    out_.origin = low_ * 0.5 + high_ * 0.5;
    low_ -= out_.origin;
    high_ -= out_.origin;
    // Half of float32's largest number, so that the difference of two vertices is one, too.
    constexpr double kLimit = 0.5 * static_cast<double>(std::numeric_limits<float>::max());
    return high_.x <= kLimit && high_.y <= kLimit && high_.z <= kLimit;
}

int Ordering::compareValues(std::uint32_t a, std::uint32_t b) const {
    for (const FieldInput& field : input_.fields) {
        if (field.association != Association::kVertex) continue;
        for (const auto& step : field.steps) {
            const auto x = static_cast<float>(step[a]);
            const auto y = static_cast<float>(step[b]);
            if (x == y || (std::isnan(x) && std::isnan(y))) continue;
            if (std::isnan(x) || std::isnan(y)) return std::isnan(y) ? -1 : 1;  // NaN comes last.
            return x < y ? -1 : 1;
        }
    }
    return 0;
}

int Ordering::comparePlaces(std::uint32_t a, std::uint32_t b) const {
    const glm::vec3 p = rounded(a);
    const glm::vec3 q = rounded(b);
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] != q[axis]) return p[axis] < q[axis] ? -1 : 1;
    }
    return compareValues(a, b);
}

void Ordering::joinVertices() {
    struct Keyed {
        std::uint64_t key;
        std::uint32_t point;
    };
    const Morton morton{low_, high_};
    std::vector<Keyed> order;
    for (std::uint32_t i = 0; i < joined_.size(); ++i) {
        // Of the rounded place, so that points that coincide have one key.
        if (joined_[i] != kNone) order.push_back({morton(glm::dvec3{rounded(i)}), i});
    }
    std::sort(order.begin(), order.end(), [this](const Keyed& a, const Keyed& b) {
        if (a.key != b.key) return a.key < b.key;
        return comparePlaces(a.point, b.point) < 0;
    });
    for (const Keyed& next : order) {
        if (places_.empty() || comparePlaces(places_.back(), next.point) != 0) {
            places_.push_back(next.point);
        }
        joined_[next.point] = static_cast<std::uint32_t>(places_.size() - 1);
    }
}

/// Puts ids in ascending order and turns the cell to positive orientation by its last two.
void normalize(Draft& draft) {
    const auto swap = [&draft](int i, int j) {
        std::swap(draft.ids[i], draft.ids[j]);
        std::swap(draft.corners[static_cast<std::size_t>(i)],
                  draft.corners[static_cast<std::size_t>(j)]);
        draft.positive = !draft.positive;
    };
    constexpr std::array<std::pair<int, int>, 5> kNetwork{{{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}}};
    for (const auto& [i, j] : kNetwork) {
        if (draft.ids[i] > draft.ids[j]) swap(i, j);
    }
    if (!draft.positive) swap(2, 3);
}

/// The ids in ascending order, of a normalised cell.
std::array<int, 4> sortedIds(const Draft& d) {
    return {d.ids.x, d.ids.y, std::min(d.ids.z, d.ids.w), std::max(d.ids.z, d.ids.w)};
}

void Ordering::nameJoinedVertices() {
    const Morton morton{low_, high_};
    std::size_t kept = 0;
    for (Draft& draft : drafts_) {
        for (int i = 0; i < 4; ++i) {
            draft.ids[i] = static_cast<int>(joined_[static_cast<std::size_t>(draft.ids[i])]);
        }
        if (!draft.positive) ++out_.cellsInverted;
        normalize(draft);
        const auto ids = sortedIds(draft);
        if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) {
            ++out_.cellsWithoutVolume;
            continue;
        }
        glm::dvec3 sum{0.0};
        for (const int id : ids) {
            sum += glm::dvec3{rounded(places_[static_cast<std::size_t>(id)])};
        }
        draft.key = morton(sum * 0.25);
        drafts_[kept++] = draft;
    }
    drafts_.resize(kept);
}

void Ordering::sortCells() {
    std::sort(drafts_.begin(), drafts_.end(), [](const Draft& a, const Draft& b) {
        if (a.key != b.key) return a.key < b.key;
        const auto idsA = sortedIds(a);
        const auto idsB = sortedIds(b);
        return idsA != idsB ? idsA < idsB : a.source < b.source;
    });
    const auto end =
        std::unique(drafts_.begin(), drafts_.end(),
                    [](const Draft& a, const Draft& b) { return sortedIds(a) == sortedIds(b); });
    out_.cellsDoubled = static_cast<std::uint64_t>(drafts_.end() - end);
    drafts_.erase(end, drafts_.end());
}

void Ordering::compactVertices() {
    std::vector<std::uint32_t> final(places_.size(), kNone);
    for (const Draft& draft : drafts_) {
        for (int i = 0; i < 4; ++i) final[static_cast<std::size_t>(draft.ids[i])] = 0;
    }
    for (std::size_t place = 0; place < places_.size(); ++place) {
        if (final[place] == kNone) continue;
        final[place] = static_cast<std::uint32_t>(out_.vertices.size());
        out_.vertices.push_back(rounded(places_[place]));
        out_.exactVertices.push_back(exact(places_[place]));
        out_.vertexSource.push_back(places_[place]);
    }
    out_.cells.reserve(drafts_.size());
    for (const Draft& draft : drafts_) {
        glm::ivec4 ids;
        for (int i = 0; i < 4; ++i) {
            ids[i] = static_cast<int>(final[static_cast<std::size_t>(draft.ids[i])]);
        }
        out_.cells.push_back(ids);
        out_.cellSource.push_back(draft.source);
        out_.cornerSource.push_back(draft.corners);
    }
}

}  // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                const glm::dvec3& d) {
    const glm::dvec3 u = b - a;
    const glm::dvec3 v = c - a;
    const glm::dvec3 w = d - a;
    const double yz = u.y * v.z;
    const double zy = u.z * v.y;
    const double zx = u.z * v.x;
    const double xz = u.x * v.z;
    const double xy = u.x * v.y;
    const double yx = u.y * v.x;
    const double volume = w.x * (yz - zy) + w.y * (zx - xz) + w.z * (xy - yx);
    const double magnitude = std::abs(w.x) * (std::abs(yz) + std::abs(zy)) +
                             std::abs(w.y) * (std::abs(zx) + std::abs(xz)) +
                             std::abs(w.z) * (std::abs(xy) + std::abs(yx));
    // Bound of the rounding error. Source: J. R. Shewchuk, Adaptive Precision Floating-Point
    // Arithmetic and Fast Robust Geometric Predicates, 1997, section 4.3: (7 + 56 u) u.
    constexpr double kBound = 7.8e-16;
    if (std::abs(volume) <= kBound * magnitude) return 0;
    return volume > 0.0 ? 1 : -1;
}

Result<OrderedMesh> orderMesh(const MeshInput& input) {
    const auto nothingLeft = [&input] {
        return fail(
            ErrorCode::kInvalidArgument,
            "mesh: none of its " + std::to_string(input.cells.size()) + " tetrahedra has a volume");
    };
    Ordering ordering{input};
    ordering.keepCellsWithVolume();
    if (ordering.empty()) return nothingLeft();
    if (!ordering.rebase()) {
        return fail(ErrorCode::kInvalidArgument, "mesh: is wider than float32 can hold");
    }
    ordering.joinVertices();
    ordering.nameJoinedVertices();
    if (ordering.empty()) return nothingLeft();
    ordering.sortCells();
    ordering.compactVertices();
    return ordering.take();
}

}  // namespace volcast::data
