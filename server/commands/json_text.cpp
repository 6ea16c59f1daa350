#include "server/commands/json_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include <boost/json.hpp>

namespace volcast::commands {

namespace {

namespace json = boost::json;

void append(std::string& text, const json::value& value);

void append(std::string& text, double number) {
    if (!std::isfinite(number)) {
        text += "null";
        return;
    }
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), end.ptr);
}

void append(std::string& text, const json::array& array) {
    text += '[';
    for (const json::value& item : array) {
        if (text.back() != '[') text += ',';
        append(text, item);
    }
    text += ']';
}

void append(std::string& text, const json::object& object) {
    text += '{';
    for (const auto& [key, value] : object) {
        if (text.back() != '{') text += ',';
        text += json::serialize(key) + ':';
        append(text, value);
    }
    text += '}';
}

void append(std::string& text, const json::value& value) {
    if (value.is_double()) {
        append(text, value.get_double());
    } else if (value.is_array()) {
        append(text, value.get_array());
    } else if (value.is_object()) {
        append(text, value.get_object());
    } else {
        text += json::serialize(value);
    }
}

}  // namespace

std::string jsonText(const json::value& value) {
    std::string text;
    append(text, value);
    return text;
}

}  // namespace volcast::commands
