#include "renderer/user_shader/parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "renderer/user_shader/css_colour.h"

namespace volcast::user_shader {
namespace {

namespace json = boost::json;

constexpr double kLargestFloat = std::numeric_limits<float>::max();

std::string joined(std::initializer_list<std::string_view> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
        text += std::data(words)[i];
    }
    return text;
}

}  // namespace

std::optional<double> numberOf(const json::value& value) {
    if (value.is_double()) return value.get_double();
    if (value.is_int64()) return static_cast<double>(value.get_int64());
    if (value.is_uint64()) return static_cast<double>(value.get_uint64());
    return std::nullopt;
}

const char* unfit(double value, NumberType type) {
    if (type == NumberType::kFloat) {
        return std::abs(value) <= kLargestFloat ? nullptr : "a number of single precision";
    }
    if (value != std::floor(value)) return "an integer";
    if (type == NumberType::kUint) {
        return value >= 0.0 && value <= 4294967295.0 ? nullptr : "an unsigned integer of 32 bits";
    }
    return value >= -2147483648.0 && value <= 2147483647.0 ? nullptr : "an integer of 32 bits";
}

std::string textOf(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

void Parameters::complain(const Parameter& parameter, std::string message) {
    complaints_.push_back(
        {.line = directive_.line, .column = parameter.valueColumn, .message = std::move(message)});
}

void Parameters::complain(std::string message) {
    complaints_.push_back({.line = directive_.line,
                           .column = directive_.controlColumn,
                           .message = std::move(message)});
}

void Parameters::allow(std::initializer_list<std::string_view> names) {
    for (const Parameter& parameter : directive_.parameters) {
        if (std::ranges::find(names, parameter.name) != names.end()) continue;
        complaints_.push_back({.line = directive_.line,
                               .column = parameter.column,
                               .message = "Invalid parameter: " + parameter.name});
    }
}

void Parameters::requireType(std::initializer_list<std::string_view> types) {
    if (std::ranges::find(types, directive_.type) != types.end()) return;
    complaints_.push_back({.line = directive_.line,
                           .column = directive_.typeColumn,
                           .message = "type must be " + joined(types)});
}

const Parameter* Parameters::find(std::string_view name) const {
    const auto found = std::ranges::find(directive_.parameters, name, &Parameter::name);
    return found == directive_.parameters.end() ? nullptr : &*found;
}

std::optional<double> Parameters::number(std::string_view name, NumberType type) {
    const Parameter* parameter = find(name);
    if (parameter == nullptr) return std::nullopt;
    const std::string expected = "Expected " + parameter->name + " argument to be ";
    const std::optional<double> value = numberOf(parameter->value);
    if (!value) {
        complain(*parameter, expected + "a number");
        return std::nullopt;
    }
    const char* const wanted = unfit(*value, type);
    if (wanted == nullptr) return value;
    complain(*parameter, expected + wanted + ", not " + textOf(*value));
    return std::nullopt;
}

std::optional<bool> Parameters::flag(std::string_view name) {
    const Parameter* parameter = find(name);
    if (parameter == nullptr) return std::nullopt;
    if (const bool* value = parameter->value.if_bool()) return *value;
    complain(*parameter, "Expected " + parameter->name + " argument to be a boolean");
    return std::nullopt;
}

std::optional<glm::vec3> Parameters::colour(std::string_view name) {
    const Parameter* parameter = find(name);
    if (parameter == nullptr) return std::nullopt;
    const json::string* text = parameter->value.if_string();
    if (text == nullptr) {
        complain(*parameter, "Expected " + parameter->name + " argument to be a string");
        return std::nullopt;
    }
    const std::optional<glm::vec3> colour = cssColour({text->data(), text->size()});
    if (!colour) {
        complain(*parameter, "Invalid " + parameter->name + " value: " +
                                 json::serialize(parameter->value) + " is not a CSS colour");
    }
    return colour;
}

std::optional<int> Parameters::channel(std::string_view name) {
    const Parameter* parameter = find(name);
    if (parameter == nullptr) return std::nullopt;
    const json::value* value = &parameter->value;
    // A list of none or one: this renderer's data has one dimension of channels.
    if (const json::array* list = value->if_array(); list != nullptr && list->size() <= 1) {
        if (list->empty()) return std::nullopt;
        value = &list->front();
    }
    const std::optional<double> index = numberOf(*value);
    constexpr double kMost = 65535.0;
    if (index && *index >= 0.0 && *index <= kMost && *index == std::floor(*index)) {
        return static_cast<int>(*index);
    }
    complain(*parameter, "Invalid " + parameter->name +
                             " value: expected a channel's number, from 0, not " +
                             json::serialize(parameter->value));
    return std::nullopt;
}

std::optional<Interval> Parameters::interval(std::string_view name, bool ordered) {
    const Parameter* parameter = find(name);
    if (parameter == nullptr) return std::nullopt;
    const json::array* ends = parameter->value.if_array();
    std::optional<double> from, to;
    if (ends != nullptr && ends->size() == 2) {
        from = numberOf((*ends)[0]);
        to = numberOf((*ends)[1]);
    }
    const bool numbers = from && to && unfit(*from, NumberType::kFloat) == nullptr &&
                         unfit(*to, NumberType::kFloat) == nullptr;
    const std::string invalid = "Invalid " + parameter->name + " value: ";
    if (!numbers) {
        complain(*parameter, invalid + "expected two numbers, [from, to], not " +
                                 json::serialize(parameter->value));
        return std::nullopt;
    }
    if (*from == *to) {
        complain(*parameter, invalid + "both ends are " + textOf(*from));
        return std::nullopt;
    }
    if (ordered && *from > *to) {
        complain(*parameter, invalid + textOf(*from) + " is above " + textOf(*to) +
                                 "; the lower end goes first");
        return std::nullopt;
    }
    return Interval{.from = *from, .to = *to};
}

}  // namespace volcast::user_shader
