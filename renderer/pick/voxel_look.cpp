#include "renderer/pick/voxel_look.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/pick/voxel_field.h"
#include "renderer/reference/linear_map.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

namespace volcast::pick {

namespace {

/// Whole steps over a length; a last one that is no more than its rounding is none.
double stepsOver(double length, double step) {
    constexpr double kRounding = 1e-9;
    return std::max(std::ceil(length / step - kRounding), 1.0);
}

using reference::LinearMap;
using reference::Ray;
using reference::Span;

/// A channel and how it is drawn.
struct Drawn {
    VoxelField field;
    LinearMap map;
    std::optional<data::Range> interval;
};

const data::Channel* channelNamed(const data::Volume& volume, const std::string& name) {
    const auto found = std::ranges::find(volume.channels, name, &data::Channel::name);
    if (found != volume.channels.end()) return &*found;
    return volume.channels.empty() || !name.empty() ? nullptr : &volume.channels.front();
}

LinearMap mapOf(const data::TransferFunction& map) {
    return {map, scene::ScaleFunction{{}, {.min = 0.0F, .max = 1.0F}}};  // Values as they are.
}

std::vector<Drawn> drawnOf(const data::Volume& volume, const scene::Layer& layer) {
    std::vector<Drawn> drawn;
    const auto add = [&](const std::string& name, const data::TransferFunction& map,
                         const std::optional<data::Range>& interval) {
        const data::Channel* channel = channelNamed(volume, name);
        if (channel == nullptr) return;
        drawn.push_back({.field = VoxelField{volume, *channel, layer.sampling},
                         .map = mapOf(map),
                         .interval = interval});
    };
    for (const scene::ChannelMap& channel : layer.channels) {
        if (channel.visible) add(channel.field, channel.map, channel.interval);
    }
    if (layer.channels.empty()) add(layer.field, layer.map, layer.interval);
    return drawn;
}

/// A ray in grid coordinates.
struct GridRay {
    glm::dvec3 origin{0.0}, direction{0.0};  ///< Grid units; a world unit.
    [[nodiscard]] glm::dvec3 at(double distance) const { return origin + distance * direction; }
};

GridRay toGrid(const data::Volume& volume, const Ray& ray) {
    const glm::dmat3 gridFromWorld = glm::transpose(volume.direction);
    return {.origin = gridFromWorld * (ray.origin - volume.origin) / volume.spacing,
            .direction = gridFromWorld * ray.direction / volume.spacing};
}

Span withinBox(const GridRay& ray, const glm::dvec3& last, Span span) {
    for (int axis = 0; axis < 3; ++axis) {
        const double rate = ray.direction[axis], start = ray.origin[axis];
        if (rate == 0.0) {
            if (start < 0.0 || start > last[axis]) span.end = span.begin - 1.0;
            continue;
        }
        const double a = -start / rate, b = (last[axis] - start) / rate;
        span.begin = std::max(span.begin, std::min(a, b));
        span.end = std::min(span.end, std::max(a, b));
    }
    return span;
}

/// Not where a voxel without a value is used.
bool counts(const Drawn& drawn, double value) {
    if (std::isnan(value)) return false;
    return !drawn.interval || (value >= drawn.interval->min && value <= drawn.interval->max);
}

scene::Picked pickedAt(const data::Volume& volume, const std::vector<Drawn>& drawn, const Ray& ray,
                       const GridRay& grid, const Place& place) {
    const glm::dvec3 at =
        glm::clamp(grid.at(place.distance), glm::dvec3{0.0}, glm::dvec3{volume.size - 1});
    scene::Picked picked{.layer = {}, .values = {}};
    picked.distance = place.distance;
    picked.position = ray.origin + place.distance * ray.direction;
    picked.voxel = glm::ivec3{glm::floor(at + 0.5)};
    picked.colour = glm::vec3{place.colour};
    const auto winner = static_cast<std::size_t>(place.item);
    picked.values.push_back({.field = drawn[winner].field.channel().name, .value = place.f});
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double value = drawn[i].field.at(at);
        if (i == winner || std::isnan(value)) continue;
        picked.values.push_back({.field = drawn[i].field.channel().name, .value = value});
    }
    return picked;
}

/// All that is gathered on the march.
struct March {
    std::vector<Strongest> strongest;  ///< One a channel.
    glm::dvec3 light{0.0};             ///< Premultiplied colour; of splat: the integral.
    double depth = 0.0;
};

March marched(const scene::Layer& layer, const std::vector<Drawn>& drawn, const GridRay& grid,
              const Span& span, Steps wanted) {
    March march;
    march.strongest.assign(drawn.size(), Strongest{layer.model});
    const double steps = stepsOver(span.end - span.begin, wanted.world);
    const double dt = (span.end - span.begin) / steps;
    const bool absorbs = layer.model == scene::RayModel::kVolume;
    const double gain = absorbs ? std::exp(static_cast<double>(layer.gain)) : 1.0;
    for (double i = 0.0; i < steps; ++i) {
        const double distance = span.begin + (i + wanted.share) * dt;
        const double through = absorbs ? std::exp(-march.depth) : 1.0;
        glm::dvec3 emitted{0.0};
        double extinction = 0.0;
        for (std::size_t c = 0; c < drawn.size(); ++c) {
            const double value = drawn[c].field.at(grid.at(distance));
            if (!counts(drawn[c], value)) continue;
            glm::dvec4 matter = drawn[c].map.at(value);
            matter.a *= gain;
            march.strongest[c].add({.distance = distance,
                                    .f = value,
                                    .g = value,
                                    .item = static_cast<int>(c),
                                    .colour = glm::dvec3{matter},
                                    .extinction = matter.a,
                                    .through = through});
            emitted += glm::dvec3{matter} * (absorbs ? matter.a : dt);
            extinction += matter.a;
        }
        if (!absorbs) {
            march.light += emitted;
        } else if (extinction > 0.0) {
            march.light -= through * std::expm1(-extinction * dt) * emitted / extinction;
        }
        march.depth += extinction * dt;
    }
    return march;
}

/// The channel that is seen most: by weight, but of extremes, which are colours added up, the
/// brightest.
const Place* winner(const scene::Layer& layer, const March& march) {
    const bool extreme =
        layer.model == scene::RayModel::kMip || layer.model == scene::RayModel::kMinip;
    const auto seen = [&](const Strongest& strongest) {
        return extreme ? weightOf(scene::RayModel::kSplat, strongest.place()) : strongest.weight();
    };
    const Strongest* best = nullptr;
    for (const Strongest& strongest : march.strongest) {
        if (!strongest.found() || showsNothing(layer.model, strongest.weight())) continue;
        if (best == nullptr || seen(strongest) > seen(*best)) best = &strongest;
    }
    return best == nullptr ? nullptr : &best->place();
}

glm::dvec4 shownBy(const scene::Layer& layer, const March& march) {
    switch (layer.model) {
        case scene::RayModel::kVolume: return {march.light, -std::expm1(-march.depth)};
        case scene::RayModel::kSplat:
            return {std::exp2(static_cast<double>(layer.exposure)) * march.light, 0.0};
        default: break;
    }
    glm::dvec3 colour{0.0};
    for (const Strongest& strongest : march.strongest) {
        if (strongest.found()) colour += strongest.place().colour;
    }
    return {colour, 1.0};
}

/// Where the field first takes a level, looked for at the ends of steps and narrowed to the last
/// bits that tell.
std::optional<Place> firstLevel(const scene::Layer& layer, const Drawn& drawn, const GridRay& grid,
                                const Span& span, double stepWorld) {
    constexpr int kHalvings = 40;
    const std::vector<float> levels = scene::levelsOf(layer);
    const double steps = stepsOver(span.end - span.begin, stepWorld);
    const double dt = (span.end - span.begin) / steps;
    const auto valueAt = [&](double distance) { return drawn.field.at(grid.at(distance)); };
    double front = valueAt(span.begin);
    for (double i = 0.0; i < steps; ++i) {
        double near = span.begin + i * dt, far = span.begin + (i + 1.0) * dt;
        const double back = valueAt(far);
        // Of several levels in a step the first on the way is met.
        const float* met = nullptr;
        for (const float& level : levels) {
            if (std::isnan(front) || std::isnan(back)) continue;
            if ((front < level) == (back < level)) continue;
            if (met == nullptr || front >= back) met = &level;
        }
        if (met == nullptr) {
            front = back;
            continue;
        }
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (near + far);
            ((valueAt(middle) < *met) == (front < *met) ? near : far) = middle;
        }
        return Place{
            .distance = far, .f = *met, .item = 0, .colour = glm::dvec3{drawn.map.at(*met)}};
    }
    return std::nullopt;
}

/// The nearest of the planes across the axes.
std::optional<Place> crossSection(const data::Volume& volume, const scene::Layer& layer,
                                  const Drawn& drawn, const GridRay& grid, const Span& span) {
    const glm::dvec3 last{volume.size - 1};
    glm::dvec3 meet = 0.5 * last;
    if (layer.crossSections.point) {
        meet = toGrid(volume, {.origin = *layer.crossSections.point}).origin;
    }
    std::optional<Place> nearest;
    for (int axis = 0; axis < 3; ++axis) {
        if (!layer.crossSections.shown[axis] || meet[axis] < 0.0 || meet[axis] > last[axis]) {
            continue;
        }
        const double distance = (meet[axis] - grid.origin[axis]) / grid.direction[axis];
        if (!(distance >= span.begin && distance <= span.end)) continue;
        if (nearest && nearest->distance <= distance) continue;
        const double value = drawn.field.at(grid.at(distance));
        if (!counts(drawn, value)) continue;
        nearest = Place{
            .distance = distance, .f = value, .item = 0, .colour = glm::dvec3{drawn.map.at(value)}};
    }
    return nearest;
}

}  // namespace

std::optional<Look> lookAt(const data::Volume& volume, const scene::Layer& layer, Steps wanted,
                           const Ray& ray, const Span& span) {
    const std::vector<Drawn> drawn = drawnOf(volume, layer);
    const GridRay grid = toGrid(volume, ray);
    const Span inside = withinBox(grid, glm::dvec3{volume.size - 1}, span);
    if (drawn.empty() || !(inside.begin <= inside.end)) return std::nullopt;
    std::optional<Place> hit;
    const bool opaque = scene::row(layer.model).opaque;
    if (layer.model == scene::RayModel::kIsosurface) {
        hit = firstLevel(layer, drawn.front(), grid, inside, wanted.world);
    } else if (opaque) {
        hit = crossSection(volume, layer, drawn.front(), grid, inside);
    }
    if (opaque) {
        if (!hit) return std::nullopt;
        return Look{.shown = {hit->colour, 1.0}, .place = pickedAt(volume, drawn, ray, grid, *hit)};
    }
    const March march = marched(layer, drawn, grid, inside, wanted);
    const Place* place = winner(layer, march);
    if (place == nullptr) return std::nullopt;
    return Look{.shown = shownBy(layer, march),
                .place = pickedAt(volume, drawn, ray, grid, *place)};
}

}  // namespace volcast::pick
