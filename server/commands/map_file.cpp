#include "server/commands/map_file.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <boost/json.hpp>

namespace volcast::commands {

namespace {

namespace json = boost::json;
using data::TransferFunction;

Error wrong(const std::string& key, const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, key + ": " + what, key);
}

Result<double> number(const json::value& value, const std::string& key) {
    boost::system::error_code error;
    const auto result = value.to_number<double>(error);
    if (error || !std::isfinite(result)) return wrong(key, "is not a finite number");
    return result;
}

/// Exactly `count` numbers.
Result<std::vector<double>> numbers(const json::value& value, std::size_t count,
                                    const std::string& key) {
    const json::array* items = value.if_array();
    if (items == nullptr || items->size() != count) {
        return wrong(key, "is not a list of " + std::to_string(count) + " numbers");
    }
    std::vector<double> result;
    for (const json::value& item : *items) {
        const auto read = number(item, key);
        if (!read) return read.error();
        result.push_back(*read);
    }
    return result;
}

float linearFromSrgb(int byte) {
    const double x = byte / 255.0;
    return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

std::optional<glm::vec3> fromHex(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    glm::vec3 colour{0.0F};
    for (int i = 0; i < 3; ++i) {
        int byte = 0;
        for (const char c : text.substr(1 + std::size_t{2} * static_cast<std::size_t>(i), 2)) {
            const bool digit = c >= '0' && c <= '9';
            const char low = static_cast<char>(c | 0x20);
            if (!digit && (low < 'a' || low > 'f')) return std::nullopt;
            byte = 16 * byte + (digit ? c - '0' : low - 'a' + 10);
        }
        colour[i] = linearFromSrgb(byte);
    }
    return colour;
}

Result<glm::vec3> colour(const json::value& value, const std::string& key) {
    if (const json::string* text = value.if_string()) {
        if (const auto read = fromHex(*text)) return *read;
    } else if (const auto rgb = numbers(value, 3, key)) {
        return glm::vec3{(*rgb)[0], (*rgb)[1], (*rgb)[2]};
    }
    return wrong(key, R"(is neither "#rrggbb" nor a list of 3 numbers)");
}

std::string entry(const char* key, std::size_t i) {
    return std::string{key} + "[" + std::to_string(i) + "]";
}

/// Calls `take` for each item of the list at `key`, until it fails.
template <class Take>
Result<void> forEach(const json::object& object, const char* key, const Take& take) {
    const json::value* value = object.if_contains(key);
    if (value == nullptr) return wrong(key, "is missing");
    const json::array* items = value->if_array();
    if (items == nullptr) return wrong(key, "is not a list");
    for (std::size_t i = 0; i < items->size(); ++i) {
        if (auto taken = take((*items)[i], entry(key, i)); !taken) return taken;
    }
    return {};
}

Result<void> checkKeys(const json::object& object, std::initializer_list<const char*> known) {
    for (const auto& item : object) {
        if (std::ranges::none_of(known, [&](const char* name) { return item.key() == name; })) {
            return wrong(std::string{item.key()}, "is not a key of such a map");
        }
    }
    return {};
}

/// What all maps over a window have in common.
struct Placed {
    data::Window window;
    double distance = 1.0;
};

Result<data::Window> percentiles(const json::value& value, const std::vector<float>& known) {
    const auto read = numbers(value, 2, "percentiles");
    if (!read) return read.error();
    for (const double p : *read) {
        if (p != std::floor(p) || p < 0.0 || p > 100.0) {
            return wrong("percentiles", std::to_string(p) + " is no whole number from 0 to 100");
        }
    }
    if (known.empty()) return wrong("percentiles", "the field has no values");
    return data::Window{.first = known[static_cast<std::size_t>((*read)[0])],
                        .last = known[static_cast<std::size_t>((*read)[1])]};
}

Result<Placed> placed(const json::object& object, const MapUsual& usual) {
    Placed found{.window = {.first = usual.window.min, .last = usual.window.max},
                 .distance = usual.distance};
    if (const json::value* value = object.if_contains("window")) {
        const auto read = numbers(*value, 2, "window");
        if (!read) return read.error();
        found.window = {.first = (*read)[0], .last = (*read)[1]};
    }
    if (const json::value* value = object.if_contains("percentiles")) {
        if (object.contains("window")) return wrong("percentiles", "there is a window, too");
        const auto read = percentiles(*value, usual.percentiles);
        if (!read) return read.error();
        found.window = *read;
    }
    if (const json::value* value = object.if_contains("distance")) {
        const auto read = number(*value, "distance");
        if (!read) return read.error();
        found.distance = *read;
    }
    return found;
}

/// 0 where it is absent, as in every JSON of a scene.
Result<void> readFloat(const json::object& object, const char* name, const std::string& key,
                       float& into) {
    const json::value* value = object.if_contains(name);
    if (value == nullptr) return {};
    const auto given = number(*value, key + "." + name);
    if (!given) return given.error();
    into = static_cast<float>(*given);
    return {};
}

Result<data::ControlPoint> pointFrom(const json::value& item, const std::string& key) {
    const json::object* object = item.if_object();
    if (object == nullptr) return wrong(key, "is not an object");
    data::ControlPoint point;
    auto read = checkKeys(*object, {"value", "colour", "extinction"});
    if (read) read = readFloat(*object, "value", key, point.value);
    if (read) read = readFloat(*object, "extinction", key, point.extinction);
    if (const json::value* colour = object->if_contains("colour"); read && colour != nullptr) {
        const json::object* parts = colour->if_object();
        if (parts == nullptr) return wrong(key + ".colour", "is not an object");
        read = checkKeys(*parts, {"r", "g", "b"});
        if (read) read = readFloat(*parts, "r", key + ".colour", point.colour.r);
        if (read) read = readFloat(*parts, "g", key + ".colour", point.colour.g);
        if (read) read = readFloat(*parts, "b", key + ".colour", point.colour.b);
    }
    if (!read) return read.error();
    return point;
}

Result<TransferFunction> fromPoints(const json::object& object) {
    TransferFunction map;
    auto read = checkKeys(object, {"points", "kind", "editor"});  // As the page saves them.
    if (!read) return read.error();
    read = forEach(object, "points", [&](const json::value& item, const std::string& key) {
        const auto point = pointFrom(item, key);
        if (!point) return Result<void>{point.error()};
        map.points.push_back(*point);
        return Result<void>{};
    });
    if (read) read = data::validate(map);
    if (!read) return read.error();
    return map;
}

Result<data::ColourPoint> colourPointFrom(const json::value& item, const std::string& key) {
    const json::array* pair = item.if_array();
    if (pair == nullptr || pair->size() != 2) {
        return wrong(key, "is not a pair [POSITION, COLOUR]");
    }
    const auto position = number((*pair)[0], key + ".position");
    if (!position) return position.error();
    const auto rgb = colour((*pair)[1], key + ".colour");
    if (!rgb) return rgb.error();
    return data::ColourPoint{.position = *position, .colour = *rgb};
}

Result<TransferFunction> fromDrawing(const json::object& object, const MapUsual& usual) {
    data::DrawnMap map;
    auto read =
        checkKeys(object, {"colours", "opacities", "curve", "window", "percentiles", "distance"});
    if (!read) return read.error();
    read = forEach(object, "colours", [&](const json::value& item, const std::string& key) {
        const auto point = colourPointFrom(item, key);
        if (!point) return Result<void>{point.error()};
        map.colours.push_back(*point);
        return Result<void>{};
    });
    if (!read) return read.error();
    read = forEach(object, "opacities", [&](const json::value& item, const std::string& key) {
        const auto pair = numbers(item, 2, key);
        if (!pair) return Result<void>{pair.error()};
        map.opacities.emplace_back((*pair)[0], (*pair)[1]);
        return Result<void>{};
    });
    if (!read) return read.error();
    if (const json::value* curve = object.if_contains("curve")) {
        const json::string* name = curve->if_string();
        if (name == nullptr || (*name != "spline" && *name != "lines")) {
            return wrong("curve", R"(is neither "spline" nor "lines")");
        }
        map.degree = *name == "lines" ? 1 : 3;
    }
    const auto place = placed(object, usual);
    if (!place) return place.error();
    map.distance = place->distance;
    return data::resolve(map, place->window, usual.axis);
}

Result<TransferFunction> fromTable(const json::object& object, const MapUsual& usual) {
    std::vector<glm::dvec4> entries;
    auto read = checkKeys(object, {"rgba", "window", "percentiles", "distance"});
    if (!read) return read.error();
    read = forEach(object, "rgba", [&](const json::value& item, const std::string& key) {
        const auto rgba = numbers(item, 4, key);
        if (!rgba) return Result<void>{rgba.error()};
        entries.emplace_back((*rgba)[0], (*rgba)[1], (*rgba)[2], (*rgba)[3]);
        return Result<void>{};
    });
    if (!read) return read.error();
    const auto place = placed(object, usual);
    if (!place) return place.error();
    return data::fromTable(entries, place->distance, place->window, usual.axis);
}

Result<TransferFunction> fromLinear(const json::object& object, const MapUsual& usual) {
    constexpr double kUsualOpacity = 0.6;
    auto read = checkKeys(object, {"linear", "opacity", "window", "percentiles", "distance"});
    if (!read) return read.error();
    const auto rgb = colour(object.at("linear"), "linear");
    if (!rgb) return rgb.error();
    double opacity = kUsualOpacity;
    if (const json::value* value = object.if_contains("opacity")) {
        const auto given = number(*value, "opacity");
        if (!given) return given.error();
        if (!(*given >= 0.0 && *given <= 1.0)) return wrong("opacity", "is not from 0 to 1");
        opacity = *given;
    }
    const auto place = placed(object, usual);
    if (!place) return place.error();
    const data::DrawnMap map = data::linearMap(*rgb, opacity, place->distance);
    return data::resolve(map, place->window, usual.axis);
}

}  // namespace

Result<TransferFunction> parseMap(std::string_view text, const MapUsual& usual) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') {
        return data::parseTransferFunction(text);
    }
    boost::system::error_code error;
    const json::value document = json::parse({text.data(), text.size()}, error);
    if (error) return fail(ErrorCode::kInvalidArgument, "is not JSON: " + error.message());
    const json::object& object = document.as_object();
    if (object.contains("points")) return fromPoints(object);
    if (object.contains("rgba")) return fromTable(object, usual);
    if (object.contains("linear")) return fromLinear(object, usual);
    return fromDrawing(object, usual);
}

}  // namespace volcast::commands
