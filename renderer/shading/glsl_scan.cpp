#include "renderer/shading/glsl_scan.h"

#include <cctype>

namespace volcast::shading {
namespace {

bool isIdentifier(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// `source` with comments blanked out; every line keeps its place.
std::string withoutComments(std::string_view source) {
    std::string text{source};
    enum class In { kCode, kLine, kBlock } in = In::kCode;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool pair = i + 1 < text.size();
        if (in == In::kCode && pair && text[i] == '/' &&
            (text[i + 1] == '/' || text[i + 1] == '*')) {
            in = text[i + 1] == '/' ? In::kLine : In::kBlock;
            text[i] = text[i + 1] = ' ';
            ++i;
        } else if (in == In::kLine && text[i] == '\n') {
            in = In::kCode;
        } else if (in == In::kBlock && pair && text[i] == '*' && text[i + 1] == '/') {
            in = In::kCode;
            text[i] = text[i + 1] = ' ';
            ++i;
        } else if (in != In::kCode && text[i] != '\n') {
            text[i] = ' ';
        }
    }
    return text;
}

/// The identifier in front of the parenthesis pair that ends before `end`, or nothing.
std::string calledBefore(std::string_view text, std::size_t end) {
    auto skipBlanks = [&](std::size_t i) {
        while (i > 0 && std::isspace(static_cast<unsigned char>(text[i - 1])) != 0) --i;
        return i;
    };
    std::size_t i = skipBlanks(end);
    if (i == 0 || text[i - 1] != ')') return {};
    int depth = 0;
    while (i > 0) {
        --i;
        depth += text[i] == ')' ? 1 : text[i] == '(' ? -1 : 0;
        if (depth == 0) break;
    }
    const std::size_t last = skipBlanks(i);
    std::size_t first = last;
    while (first > 0 && isIdentifier(text[first - 1])) --first;
    return std::string{text.substr(first, last - first)};
}

}  // namespace

std::vector<FunctionDefinition> functionDefinitions(std::string_view source) {
    const std::string text = withoutComments(source);
    std::vector<FunctionDefinition> found;
    int depth = 0, line = 1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') ++line;
        if (text[i] == '{' && depth++ == 0) {
            std::string name = calledBefore(text, i);
            if (!name.empty()) found.push_back({.name = std::move(name), .line = line});
        }
        if (text[i] == '}') --depth;
    }
    return found;
}

}  // namespace volcast::shading
