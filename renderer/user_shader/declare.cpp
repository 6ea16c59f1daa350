#include "renderer/user_shader/declare.h"

#include <algorithm>

#include "renderer/user_shader/declare_points.h"
#include "renderer/user_shader/parameters.h"

namespace volcast::user_shader {
namespace {

namespace json = boost::json;

constexpr std::size_t kMaxOptions = 64;

NumberType numberTypeOf(const std::string& type) {
    return type == "int"    ? NumberType::kInt
           : type == "uint" ? NumberType::kUint
                            : NumberType::kFloat;
}

Slider slider(Parameters& given) {
    given.requireType({"float", "int", "uint"});
    given.allow({"min", "max", "default", "step"});
    const NumberType type = numberTypeOf(given.directive().type);
    const std::optional<double> min = given.number("min", type);
    const std::optional<double> max = given.number("max", type);
    const std::optional<double> initial = given.number("default", type);
    const std::optional<double> step = given.number("step", type);
    if (given.find("min") == nullptr) given.complain("min must be specified");
    if (given.find("max") == nullptr) given.complain("max must be specified");
    if (step && !(*step > 0.0)) {
        given.complain(*given.find("step"), "step must be above 0, not " + textOf(*step));
    }
    if (!min || !max) return {};
    const std::string range = textOf(*min) + " to " + textOf(*max);
    if (*min > *max) given.complain(*given.find("min"), "min must not be above max: " + range);
    if (*min <= *max && initial && (*initial < *min || *initial > *max)) {
        given.complain(*given.find("default"), "default must be within valid range: " +
                                                   textOf(*initial) + " is not in " + range);
    }
    const bool real = type == NumberType::kFloat;
    return {.type = type,
            .min = *min,
            .max = *max,
            .step = step.value_or(!real         ? 1.0
                                  : *min < *max ? (*max - *min) / 100.0
                                                : 1.0),
            .initial = initial.value_or(real ? 0.5 * *min + 0.5 * *max : *min)};
}

Colour colour(Parameters& given) {
    given.requireType({"vec3"});
    given.allow({"default"});
    return {.initial = given.colour("default").value_or(glm::vec3(1.0F))};
}

Checkbox checkbox(Parameters& given) {
    given.requireType({"bool"});
    given.allow({"default"});
    return {.initial = given.flag("default").value_or(false)};
}

/// One option's value; nothing where it is of the wrong kind.
std::optional<std::variant<double, std::string>> optionValue(const Select& select,
                                                             const json::value& value) {
    if (select.texts) {
        const json::string* text = value.if_string();
        if (text == nullptr) return std::nullopt;
        return std::string{text->data(), text->size()};
    }
    const std::optional<double> number = numberOf(value);
    if (!number || unfit(*number, select.type) != nullptr) return std::nullopt;
    return *number;
}

std::string labelOf(const std::variant<double, std::string>& value) {
    const double* number = std::get_if<double>(&value);
    return number == nullptr ? std::get<std::string>(value) : textOf(*number);
}

void addOption(Select& select, Parameters& given, const json::value& value,
               const std::optional<std::string>& label) {
    const Parameter& options = *given.find("options");
    const auto read = optionValue(select, value);
    if (!read) {
        given.complain(options, "Invalid options value: " + json::serialize(value) + " is not a " +
                                    (select.texts ? "string" : name(select.type)));
        return;
    }
    const bool taken =
        std::ranges::find(select.options, *read, &Select::Option::value) != select.options.end();
    if (taken) {
        given.complain(options,
                       "Invalid options value: " + json::serialize(value) + " is listed twice");
        return;
    }
    select.options.push_back({.label = label.value_or(labelOf(*read)), .value = *read});
}

void readOptions(Select& select, Parameters& given) {
    const Parameter* options = given.find("options");
    if (options == nullptr) {
        given.complain("options must be specified");
        return;
    }
    if (const json::array* list = options->value.if_array()) {
        for (const json::value& value : *list) addOption(select, given, value, std::nullopt);
    } else if (const json::object* labelled = options->value.if_object()) {
        for (const auto& entry : *labelled) {
            addOption(select, given, entry.value(),
                      std::string{entry.key().data(), entry.key().size()});
        }
    } else {
        given.complain(*options, "Expected options argument to be a list, or labels with values");
        return;
    }
    const std::size_t count = options->value.is_array() ? options->value.get_array().size()
                                                        : options->value.get_object().size();
    if (count == 0) given.complain(*options, "options must not be empty");
    if (count > kMaxOptions) {
        given.complain(*options,
                       std::to_string(count) + " options, at most " + std::to_string(kMaxOptions));
    }
}

Select select(Parameters& given) {
    given.requireType({"string_t", "int", "uint", "float"});
    given.allow({"options", "default"});
    const std::string& type = given.directive().type;
    Select select;
    select.texts = type == "string_t";
    select.type = select.texts ? NumberType::kInt : numberTypeOf(type);
    readOptions(select, given);
    const Parameter* initial = given.find("default");
    if (initial == nullptr) return select;
    const auto value = optionValue(select, initial->value);
    const auto found = value ? std::ranges::find(select.options, *value, &Select::Option::value)
                             : select.options.end();
    if (found == select.options.end()) {
        given.complain(
            *initial, "default must be one of the options, not " + json::serialize(initial->value));
    } else {
        select.initial = static_cast<std::size_t>(found - select.options.begin());
    }
    return select;
}

InvLerp invLerp(Parameters& given) {
    given.requireType({"invlerp"});
    given.allow({"range", "window", "channel", "clamp"});
    return {.range = given.interval("range", false),
            .window = given.interval("window", true),
            .channel = given.channel("channel"),
            .clamp = given.flag("clamp").value_or(true)};
}

}  // namespace

std::optional<Control> declare(const Directive& directive, std::vector<Complaint>& complaints) {
    const std::size_t before = complaints.size();
    Parameters given{directive, complaints};
    Control control{.name = directive.name, .line = directive.line, .kind = {}};
    if (directive.control == "slider") {
        control.kind = slider(given);
    } else if (directive.control == "color") {
        control.kind = colour(given);
    } else if (directive.control == "checkbox") {
        control.kind = checkbox(given);
    } else if (directive.control == "select") {
        control.kind = select(given);
    } else if (directive.control == "invlerp") {
        control.kind = invLerp(given);
    } else if (directive.control == "transferFunction") {
        control.kind = transferFunction(given);
    } else {
        given.complain("Invalid control type " + directive.control +
                       "; one of slider, color, checkbox, select, invlerp, transferFunction");
    }
    return complaints.size() == before ? std::optional{std::move(control)} : std::nullopt;
}

}  // namespace volcast::user_shader
