#include "renderer/user_shader/declare_points.h"

#include <algorithm>

#include "renderer/user_shader/css_colour.h"

namespace volcast::user_shader {
namespace {

namespace json = boost::json;

constexpr const char* kPointForm = "[value, \"#rrggbb\", opacity from 0 to 1]";
constexpr const char* kOldPointForm = "[value, r, g, b, a], the last four from 0 to 255";

std::optional<double> numberWithin(const json::value& value, double least, double most) {
    const std::optional<double> number = numberOf(value);
    return number && *number >= least && *number <= most ? number : std::nullopt;
}

std::optional<double> place(const json::value& value) {
    const std::optional<double> number = numberOf(value);
    return number && unfit(*number, NumberType::kFloat) == nullptr ? number : std::nullopt;
}

std::optional<OpacityPoint> point(const json::value& value) {
    const json::array* parts = value.if_array();
    if (parts == nullptr || parts->size() != 3) return std::nullopt;
    const std::optional<double> at = place((*parts)[0]);
    const json::string* text = (*parts)[1].if_string();
    const std::optional<double> opacity = numberWithin((*parts)[2], 0.0, 1.0);
    if (!at || text == nullptr || !opacity) return std::nullopt;
    const std::optional<glm::vec3> colour = cssColour({text->data(), text->size()});
    if (!colour) return std::nullopt;
    return OpacityPoint{.value = *at, .colour = *colour, .opacity = *opacity};
}

std::optional<OpacityPoint> oldPoint(const json::value& value) {
    const json::array* parts = value.if_array();
    if (parts == nullptr || parts->size() != 5) return std::nullopt;
    const std::optional<double> at = place((*parts)[0]);
    if (!at) return std::nullopt;
    glm::dvec4 bytes{0.0};
    for (int i = 0; i < 4; ++i) {
        const std::optional<double> byte = numberWithin((*parts)[i + 1], 0.0, 255.0);
        if (!byte) return std::nullopt;
        bytes[i] = *byte / 255.0;
    }
    return OpacityPoint{.value = *at, .colour = glm::vec3(bytes), .opacity = bytes.a};
}

std::optional<std::vector<OpacityPoint>> points(Parameters& given, const Parameter* list,
                                                bool old) {
    if (list == nullptr) return std::nullopt;
    const json::array* items = list->value.if_array();
    if (items == nullptr) {
        given.complain(*list, "Expected " + list->name + " argument to be a list of points");
        return std::nullopt;
    }
    if (items->size() > TransferFunction::kMaxPoints) {
        given.complain(*list, std::to_string(items->size()) + " points, at most " +
                                  std::to_string(TransferFunction::kMaxPoints));
        return std::nullopt;
    }
    std::vector<OpacityPoint> read;
    for (const json::value& item : *items) {
        const std::optional<OpacityPoint> one = old ? oldPoint(item) : point(item);
        if (!one) {
            given.complain(*list, "Invalid " + list->name + " value: " + json::serialize(item) +
                                      " is not " + (old ? kOldPointForm : kPointForm));
            return std::nullopt;
        }
        read.push_back(*one);
    }
    // The order of equal values is kept: two of them make a step.
    std::ranges::stable_sort(read, {}, &OpacityPoint::value);
    return read;
}

}  // namespace

TransferFunction transferFunction(Parameters& given) {
    given.requireType({"transferFunction"});
    const bool old = given.find("points") != nullptr || given.find("range") != nullptr ||
                     given.find("color") != nullptr;
    if (old) {
        given.allow({"channel", "color", "range", "points"});
    } else {
        given.allow({"window", "controlPoints", "channel", "defaultColor"});
    }
    return {
        .window = given.interval(old ? "range" : "window", true),
        .points = points(given, given.find(old ? "points" : "controlPoints"), old),
        .channel = given.channel("channel"),
        .defaultColour = given.colour(old ? "color" : "defaultColor").value_or(glm::vec3(1.0F))};
}

}  // namespace volcast::user_shader
