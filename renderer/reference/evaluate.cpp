#include "renderer/reference/evaluate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/reference/shown.h"
#include "renderer/reference/surface.h"
#include "renderer/reference/voxel_layer.h"
#include "renderer/scene/ray_models.h"

namespace volcast::reference {
namespace {

bool gathersSmoothly(scene::RayModel model) {
    return model == scene::RayModel::kVolume || model == scene::RayModel::kXray ||
           model == scene::RayModel::kSplat;
}

void mixIn(std::uint64_t& hash, std::uint64_t value) {
    constexpr std::uint64_t kPrime = 1099511628211U;  // FNV-1a's.
    hash = (hash ^ value) * kPrime;
}

/// How often a ray enters what it gathers from.
std::uint64_t entries(std::span<const Part> parts) {
    constexpr double kTouch = 1e-9;  // Of a distance: far above rounding, far below what shows.
    std::uint64_t count = 0;
    double end = -std::numeric_limits<double>::infinity();
    for (const Part& part : parts) {
        count += part.front > end + kTouch * std::abs(part.front) ? 1U : 0U;
        end = std::max(end, part.front + part.length);
    }
    return count;
}

/// What a layer that ends no rays shows of its parts.
glm::dvec4 gathered(const LayerData& data, std::span<const Part> parts,
                    std::vector<double>& bends) {
    if (data.layer->model != scene::RayModel::kVolume) {
        return shownWithoutVolume(data, parts, bends);
    }
    return volume(parts, {.colour = &data.colour, .extinction = &data.extinction}, bends);
}

/// Fills in the pieces of a ray that meet the layer's data.
void trace(const LayerData& data, const Ray& ray, const Span& span, Scratch& scratch,
           Sight& sight) {
    if (data.grid) {
        data.grid->trace(ray, span, scratch.walls, scratch.voxelPieces);
        sight.pieces += scratch.voxelPieces.size();
        return;
    }
    data.caster->trace(ray, span, data.kept, data.f, data.g, scratch.pieces);
    sight.pieces += scratch.pieces.size();
}

}  // namespace

Evaluator::Evaluator(const scene::Scene& scene, std::span<const LayerData> layers,
                     scene::PictureSize size)
    : clipPlanes_{scene.clipPlanes}, layers_{layers}, lens_{scene.camera, size} {
    for (const LayerData& data : layers) {
        const bool jumps = data.grid && !data.grid->continuous();
        mayJump_ = mayJump_ || jumps || !gathersSmoothly(data.layer->model);
    }
}

void Evaluator::meetBoundary(const LayerData& data, const Ray& ray, const glm::dvec2& place,
                             const Span& span, Scratch& scratch, Hit& hit, Sight& sight) const {
    const scene::Layer& layer = *data.layer;
    const data::Mesh& mesh = data.caster->mesh();
    const auto found = nearestBoundary(mesh, ray, span, data.interval, scratch);
    mixIn(sight.folds, found ? static_cast<std::uint64_t>(found->points) : 0U);
    if (!found || found->distance >= hit.distance) return;
    hit.distance = found->distance;
    hit.facing = found->facing;
    hit.colour =
        layer.coloured ? glm::dvec3{data.colour.at(found->f)} : glm::dvec3{layer.surfaceColour};
    if (layer.headlight) hit.colour *= found->facing;
    if (layer.model != scene::RayModel::kWireframe) return;
    double pixels = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto at = [&](std::size_t corner) {
            const auto vertex = static_cast<std::size_t>(found->face[corner]);
            return mesh.origin + glm::dvec3{mesh.vertices[vertex]};
        };
        pixels = std::min(pixels, lens_.pixelsToLine(place, at(i), at((i + 1) % 3)));
    }
    const double edge = std::clamp(0.5 * layer.edgeWidth + 0.5 - pixels, 0.0, 1.0);
    hit.colour = glm::mix(hit.colour, glm::dvec3{layer.edgeColour}, edge);
}

void Evaluator::meetLevel(const LayerData& data, const Ray& ray, const Span& span, Scratch& scratch,
                          Hit& hit, Sight& sight) {
    const auto found = data.grid ? firstLevel(scratch.voxelPieces, data.levels)
                                 : firstLevel(scratch.pieces, span, data.levels);
    mixIn(sight.folds, found ? static_cast<std::uint64_t>(found->crossings) : 0U);
    if (!found || found->distance >= hit.distance) return;
    hit.distance = found->distance;
    hit.level = found->level;
    hit.facing = data.grid
                     ? facingSlope(*data.grid, ray, found->distance)
                     : facingGradient(data.caster->mesh(), found->cell, data.f, ray.direction);
    hit.colour =
        glm::dvec3{data.twoFields ? data.extinction.at(found->g) : data.colour.at(found->level)};
    if (data.layer->headlight) hit.colour *= hit.facing;
}

bool Evaluator::apart(const Sight& a, const Sight& b) const {
    if (a.shape != b.shape) return true;
    if (a.folds == b.folds || !std::isfinite(a.distance)) return false;
    // A smooth surface is sqrt(2) pixels times its slope apart from one corner to the next. What
    // lies behind a fold knows nothing of the fold's slope: it is the farther one's that counts.
    const Sight& far = a.distance > b.distance ? a : b;
    const double cosine = std::max(far.facing, 1e-9);
    const double slope = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine;
    return std::abs(a.distance - b.distance) > 2.0 * lens_.pixelSize(far.distance) * (slope + 1.0);
}

glm::dvec4 Evaluator::through(const LayerData& data, const Ray& ray, const Span& span, bool colours,
                              Scratch& scratch, Sight& sight) {
    trace(data, ray, span, scratch, sight);
    if (data.grid) {
        cutVoxels(data.interval, scratch.voxelPieces);
        mixIn(sight.shape, entries(scratch.voxelPieces));
        return colours ? gathered(data, ray, scratch.voxelPieces) : glm::dvec4{0.0};
    }
    cut(scratch.pieces, span, data.interval, scratch.parts);
    mixIn(sight.shape, entries(scratch.parts));
    return colours ? gathered(data, scratch.parts, scratch.bends) : glm::dvec4{0.0};
}

Sight Evaluator::look(const glm::dvec2& place, bool colours, Scratch& scratch) const {
    ++scratch.rays;
    Sight sight;
    const Ray ray = lens_.through(place);
    Span span = keptBy(clipPlanes_, ray);
    Hit hit;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const LayerData& data = layers_[i];
        if (!scene::row(data.layer->model).opaque) continue;
        trace(data, ray, span, scratch, sight);
        const double before = hit.distance;
        if (data.layer->model == scene::RayModel::kIsosurface) {
            meetLevel(data, ray, span, scratch, hit, sight);
        } else {
            meetBoundary(data, ray, place, span, scratch, hit, sight);
        }
        if (hit.distance < before) hit.layer = i;
    }
    mixIn(sight.shape, hit.layer);
    mixIn(sight.shape, std::bit_cast<std::uint64_t>(hit.level));
    sight.distance = hit.distance;
    sight.facing = hit.facing;
    sight.colour = std::isfinite(hit.distance) ? glm::dvec4{hit.colour, 1.0} : glm::dvec4{0.0};
    span.end = std::min(span.end, hit.distance);
    for (const LayerData& data : layers_) {
        if (scene::row(data.layer->model).opaque) continue;
        const glm::dvec4 own = through(data, ray, span, colours, scratch, sight);
        sight.colour = own + (1.0 - own.a) * sight.colour;
    }
    return sight;
}

}  // namespace volcast::reference
