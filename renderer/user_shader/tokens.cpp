#include "renderer/user_shader/tokens.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace volcast::user_shader {
namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

bool isWord(char c) {
    return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Operators of more than one character; none begins another that stands before it.
constexpr std::string_view kOperators[] = {
    "<<=", ">>=", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "^^",
    "++",  "--",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="};
constexpr std::string_view kSymbols = "+-*/%<>=!&|^~?:;,.(){}[]";

std::size_t wordLength(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, isWord) - text.begin());
}

std::size_t numberLength(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        const bool sign = (text[i] == '+' || text[i] == '-') && i > 0 &&
                          (text[i - 1] == 'e' || text[i - 1] == 'E') && !text.starts_with("0x") &&
                          !text.starts_with("0X");
        if (!isWord(text[i]) && text[i] != '.' && !sign) break;
        ++i;
    }
    return i;
}

std::size_t symbolLength(std::string_view text) {
    for (const std::string_view symbol : kOperators) {
        if (text.starts_with(symbol)) return symbol.size();
    }
    return kSymbols.find(text.front()) == std::string_view::npos ? 0 : 1;
}

std::string complaintOf(std::string_view rest) {
    const auto byte = static_cast<unsigned char>(rest.front());
    if (rest.front() == '#') {
        std::size_t from = 1;
        while (from < rest.size() && rest[from] == ' ') ++from;
        return "#" + std::string{rest.substr(from, wordLength(rest.substr(from)))} +
               " is not allowed; #uicontrol is the only directive";
    }
    if (byte > 32 && byte < 127) {
        return "the character " + std::string(1, rest.front()) + " is not allowed";
    }
    return "byte " + std::to_string(byte) + " is not allowed; code is ASCII";
}

}  // namespace

std::vector<Token> tokensOf(std::string_view body, std::vector<Complaint>& complaints) {
    std::vector<Token> tokens;
    int line = 1;
    std::size_t lineBegin = 0;
    for (std::size_t i = 0; i < body.size();) {
        const char c = body[i];
        if (c == '\n') {
            ++line;
            lineBegin = ++i;
            continue;
        }
        if (c == ' ' || c == '\t' || c == '\r') {
            ++i;
            continue;
        }
        const std::string_view rest = body.substr(i);
        Token token;
        token.line = line;
        token.column = static_cast<int>(i - lineBegin) + 1;
        std::size_t length = 0;
        if (isDigit(c) || (c == '.' && rest.size() > 1 && isDigit(rest[1]))) {
            token.kind = Token::Kind::kNumber;
            length = numberLength(rest);
        } else if (isWord(c)) {
            token.kind = Token::Kind::kWord;
            length = wordLength(rest);
        } else {
            length = symbolLength(rest);
        }
        if (length == 0) {
            complaints.push_back(
                {.line = line, .column = token.column, .message = complaintOf(rest)});
            i = std::min(body.find('\n', i), body.size());  // One complaint a line.
            continue;
        }
        token.text = rest.substr(0, length);
        tokens.push_back(token);
        i += length;
    }
    return tokens;
}

}  // namespace volcast::user_shader
