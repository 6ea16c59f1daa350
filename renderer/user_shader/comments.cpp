#include "renderer/user_shader/comments.h"

namespace volcast::user_shader {
namespace {

/// One past the end of what begins at `begin` and ends with `terminator`.
std::size_t endOf(std::string_view text, std::size_t begin, std::string_view terminator) {
    const std::size_t found = text.find(terminator, begin);
    return found == std::string_view::npos ? text.size() : found + terminator.size();
}

/// One past a string literal's closing quote; a literal ends with its line at the latest.
std::size_t endOfLiteral(std::string_view text, std::size_t begin) {
    for (std::size_t i = begin + 1; i < text.size() && text[i] != '\n'; ++i) {
        if (text[i] == '\\') {
            ++i;
        } else if (text[i] == '"') {
            return i + 1;
        }
    }
    return std::min(text.find('\n', begin), text.size());
}

}  // namespace

std::string withoutComments(std::string_view code) {
    std::string text{code};
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view{text}.substr(i);
        if (rest.starts_with('"')) {
            i = endOfLiteral(text, i);
            continue;
        }
        const bool line = rest.starts_with("//");
        if (!line && !rest.starts_with("/*")) {
            ++i;
            continue;
        }
        std::size_t end =
            line ? std::min(text.find('\n', i), text.size()) : endOf(text, i + 2, "*/");
        for (; i < end; ++i) {
            if (text[i] != '\n') text[i] = ' ';
        }
    }
    return text;
}

}  // namespace volcast::user_shader
