#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"

namespace volcast::scene {

/// How classify/transfer_function.glsl finds a value; the constants kMapSearch and kDensitySearch.
enum class MapSearch { kCompareAll = 0, kGrid = 1, kHalve = 2, kSlopes = 3 };

/// One level of an isosurface and its colour, linear RGB.
struct LevelColour {
    float value = 0.0F;
    glm::vec3 colour{0.0F};
    friend bool operator==(const LevelColour&, const LevelColour&) = default;
};

/// What a layer's programs look up. All values are as rays see them: scaled.
struct MapContent {
    data::TransferFunction map;
    data::TransferFunction densityMap = {};  ///< No points: none.
    std::vector<LevelColour> levels = {};    ///< Ascending.
    bool largestColours = false;             ///< The section that mip_colour asks.
    bool preintegrated = false;              ///< The section of the integrator of that name.
    friend bool operator==(const MapContent&, const MapContent&) = default;
};

/// Entries along each axis of the pre-integrated table; the constant kPreintegratedSide.
inline constexpr int kPreintegratedSide = 256;

/// Texels before the first piece; they are a uniform block too.
inline constexpr std::size_t kMapHeaderTexels = 28;

/// Maps as texels; the layout is described in classify/transfer_function.glsl.
struct MapTexels {
    std::vector<glm::vec4> texels;
    MapSearch search = MapSearch::kCompareAll;
    MapSearch densitySearch = MapSearch::kCompareAll;
    int slopes = 0, densitySlopes = 0;  ///< kSlopes: how many are added up, 4 or 7.
};

/// `content.map` must be valid.
MapTexels mapTexels(const MapContent& content);

/// For each power of two, rows of n texels: the largest red, green and blue of 2^row points from
/// the i-th on (fewer at the end).
std::vector<glm::vec4> largestColours(const data::TransferFunction& map);

/// kPreintegratedSide^2 texels, the front value changing fastest: extinction-weighted mean colour
/// and mean extinction over [front, back], both from the map's first to its last value.
///
/// Source: K. Engel, M. Kraus, T. Ertl, High-Quality Pre-Integrated Volume Rendering, 2001.
std::vector<glm::vec4> preintegrated(const data::TransferFunction& map);

}  // namespace volcast::scene
