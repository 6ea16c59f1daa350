#include "renderer/pick/mesh_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/reference/surface.h"
#include "renderer/scene/scale.h"

namespace volcast::pick {

namespace {

using reference::LayerData;
using reference::Part;
using reference::Piece;
using reference::Ray;
using reference::Scratch;
using reference::Span;

const data::Field* fieldNamed(const data::Mesh& mesh, const std::string& name) {
    const auto found = std::ranges::find(mesh.fields, name, &data::Field::name);
    if (found != mesh.fields.end()) return &*found;
    return mesh.fields.empty() ? nullptr : &mesh.fields.front();
}

/// A scaled value in the field's unit again: the inverse of ScaleFunction::ofPoint.
double unscaled(const scene::Scale& scale, const data::Range& range, double value) {
    const scene::ScaleFunction function{scale, range};
    const data::Range domain = function.domain();
    const double low = domain.min;
    switch (scale.kind) {
        case scene::Scale::Kind::kLinear: return value - function.ofPoint(0.0F);
        case scene::Scale::Kind::kLog: return std::exp(value);
        case scene::Scale::Kind::kPower: break;
    }
    const double share = std::pow(std::abs(value), 1.0 / scale.exponent);
    return low + (domain.max - low) * std::copysign(share, value);
}

/// The value at a point of a cell, linear between its corners.
double valueIn(const data::Mesh& mesh, const reference::FieldValues& field, int cell,
               const glm::dvec3& point) {
    const glm::ivec4 ids = mesh.cells[static_cast<std::size_t>(cell)];
    std::array<glm::dvec3, 4> to;
    for (int i = 0; i < 4; ++i) {
        to[static_cast<std::size_t>(i)] =
            mesh.origin + glm::dvec3{mesh.vertices[static_cast<std::size_t>(ids[i])]} - point;
    }
    const auto volume = [&](int a, int b, int c) {
        const auto at = [&](int i) { return to[static_cast<std::size_t>(i)]; };
        return glm::dot(at(a), glm::cross(at(b), at(c)));
    };
    const glm::dvec4 parts{volume(1, 3, 2), volume(0, 2, 3), volume(0, 3, 1), volume(0, 1, 2)};
    const double whole = parts.x + parts.y + parts.z + parts.w;
    double value = 0.0;
    for (int i = 0; i < 4; ++i) {
        value += field.at(cell, i, ids[i]) * (whole != 0.0 ? parts[i] / whole : 0.25);
    }
    return value;
}

/// Looks at matter along the parts: at their ends, where a map bends, and in between.
template <class Visit>
void visitPlaces(const LayerData& data, Scratch& scratch, const Visit& visit) {
    constexpr int kBetween = 4;
    double depth = 0.0;
    for (const Part& part : scratch.parts) {
        std::vector<double>& bends = scratch.bends;
        bends.assign({0.0, 1.0});
        data.colour.addBends(part.f0, part.f1, bends);
        data.extinction.addBends(part.g0, part.g1, bends);
        std::ranges::sort(bends);
        for (std::size_t i = 1; i < bends.size(); ++i) {
            if (!(bends[i] > bends[i - 1])) continue;
            const double middle = 0.5 * (bends[i - 1] + bends[i]);
            const std::size_t ofF = data.colour.pieceAt(std::lerp(part.f0, part.f1, middle));
            const std::size_t ofG = data.extinction.pieceAt(std::lerp(part.g0, part.g1, middle));
            const double length = part.length * (bends[i] - bends[i - 1]) / kBetween;
            double before = 0.0;
            for (int k = 0; k <= kBetween; ++k) {
                const double share =
                    std::lerp(bends[i - 1], bends[i], static_cast<double>(k) / kBetween);
                Place place{.distance = part.front + share * part.length,
                            .f = std::lerp(part.f0, part.f1, share),
                            .g = std::lerp(part.g0, part.g1, share),
                            .item = part.cell};
                place.colour = glm::dvec3{data.colour.on(ofF, place.f)};
                place.extinction = data.extinction.on(ofG, place.g).a;
                if (k > 0) depth += 0.5 * (before + place.extinction) * length;
                before = place.extinction;
                place.through = std::exp(-depth);
                visit(place);
            }
        }
    }
}

/// What the whole ray shows: how much of the pixel is this layer's.
glm::dvec4 shownBy(const LayerData& data, Scratch& scratch, const Place& strongest) {
    const scene::Layer& layer = *data.layer;
    switch (layer.model) {
        case scene::RayModel::kVolume:
            return reference::volume(scratch.parts,
                                     {.colour = &data.colour, .extinction = &data.extinction},
                                     scratch.bends);
        case scene::RayModel::kSplat:
            return {std::exp2(static_cast<double>(layer.exposure)) *
                        reference::colourIntegral(scratch.parts, data.colour, scratch.bends),
                    0.0};
        default: return {strongest.colour, 1.0};
    }
}

scene::Picked pickedAt(const LayerData& data, const Ray& ray, const Place& place) {
    const scene::Layer& layer = *data.layer;
    const data::Mesh& mesh = data.caster->mesh();
    scene::Picked picked{.layer = {}, .values = {}};
    picked.distance = place.distance;
    picked.position = ray.origin + place.distance * ray.direction;
    picked.cell = static_cast<std::uint32_t>(place.item);
    picked.colour = glm::vec3{place.colour};
    if (const data::Field* field = fieldNamed(mesh, layer.field); field != nullptr) {
        picked.values.push_back(
            {.field = field->name, .value = unscaled(layer.scale, field->range, place.f)});
    }
    if (!data.twoFields) return picked;
    if (const data::Field* field = fieldNamed(mesh, layer.densityField); field != nullptr) {
        picked.values.push_back(
            {.field = field->name, .value = unscaled(layer.densityScale, field->range, place.g)});
    }
    return picked;
}

std::optional<Look> matter(const LayerData& data, const Ray& ray, const Span& span,
                           Scratch& scratch) {
    reference::cut(scratch.pieces, span, data.interval, scratch.parts);
    Strongest strongest{data.layer->model};
    visitPlaces(data, scratch, [&](const Place& place) { strongest.add(place); });
    if (!strongest.found()) return std::nullopt;
    if (showsNothing(data.layer->model, strongest.weight())) return std::nullopt;
    const Place place = strongest.place();
    return Look{.shown = shownBy(data, scratch, place), .place = pickedAt(data, ray, place)};
}

std::optional<Look> isosurface(const LayerData& data, const Ray& ray, const Span& span,
                               const Scratch& scratch) {
    const auto hit = reference::firstLevel(scratch.pieces, span, data.levels);
    if (!hit) return std::nullopt;
    const Place place{.distance = hit->distance,
                      .f = hit->level,
                      .g = hit->g,
                      .item = hit->cell,
                      .colour = glm::dvec3{data.twoFields ? data.extinction.at(hit->g)
                                                          : data.colour.at(hit->level)}};
    return Look{.shown = {place.colour, 1.0}, .place = pickedAt(data, ray, place)};
}

/// Of a layer that reads no field the values are looked up all the same.
void addValues(const LayerData& data, scene::Picked& picked) {
    const data::Mesh& mesh = data.caster->mesh();
    picked.values.clear();
    const data::Field* field = fieldNamed(mesh, data.layer->field);
    if (field == nullptr) return;
    const std::size_t last = field->steps.size() - 1;
    const auto step = std::min(static_cast<std::size_t>(data.layer->timeStep), last);
    const double value =
        valueIn(mesh, {.association = field->association, .values = field->steps[step].data()},
                static_cast<int>(*picked.cell), picked.position);
    if (std::isfinite(value)) picked.values.push_back({.field = field->name, .value = value});
}

std::optional<Look> surface(const LayerData& data, const Ray& ray, const Span& span,
                            Scratch& scratch) {
    const auto hit =
        reference::nearestBoundary(data.caster->mesh(), ray, span, data.interval, scratch);
    if (!hit) return std::nullopt;
    const auto holds = [&](const Piece& piece) {
        return (piece.front.face == hit->face && piece.front.distance == hit->distance) ||
               (piece.back.face == hit->face && piece.back.distance == hit->distance);
    };
    const auto piece = std::ranges::find_if(scratch.pieces, holds);
    const scene::Layer& layer = *data.layer;
    const Place place{.distance = hit->distance,
                      .f = hit->f,
                      .item = piece->cell,
                      .colour = layer.coloured ? glm::dvec3{data.colour.at(hit->f)}
                                               : glm::dvec3{layer.surfaceColour}};
    Look look{.shown = {place.colour, 1.0}, .place = pickedAt(data, ray, place)};
    if (data.f.values == nullptr) addValues(data, look.place);
    return look;
}

}  // namespace

std::optional<Look> lookAt(const LayerData& data, const Ray& ray, const Span& span,
                           Scratch& scratch) {
    data.caster->trace(ray, span, data.kept, data.f, data.g, scratch.pieces);
    switch (data.layer->model) {
        case scene::RayModel::kSurface:
        case scene::RayModel::kWireframe: return surface(data, ray, span, scratch);
        case scene::RayModel::kIsosurface: return isosurface(data, ray, span, scratch);
        default: return matter(data, ray, span, scratch);
    }
}

}  // namespace volcast::pick
