#include "renderer/user_shader/check_text.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "renderer/user_shader/names.h"
#include "renderer/user_shader/text_limits.h"
#include "renderer/user_shader/words.h"

namespace volcast::user_shader {
namespace {

Complaint complaintAt(const Token& token, std::string message) {
    return {.line = token.line, .column = token.column, .message = std::move(message)};
}

/// Brackets must match and not nest too deeply, which parsers answer with their own stack.
void checkBrackets(const std::vector<Token>& tokens, std::vector<Complaint>& complaints) {
    constexpr std::string_view kOpen = "([{", kClose = ")]}";
    std::vector<const Token*> open;
    for (const Token& token : tokens) {
        if (token.kind != Token::Kind::kSymbol || token.text.size() != 1) continue;
        if (kOpen.find(token.text) != std::string_view::npos) {
            open.push_back(&token);
            if (open.size() > kMaxNesting) {
                complaints.push_back(complaintAt(token, "brackets are nested more than " +
                                                            std::to_string(kMaxNesting) + " deep"));
                return;
            }
        }
        const std::size_t kind = kClose.find(token.text);
        if (kind == std::string_view::npos) continue;
        if (open.empty() || open.back()->text != kOpen.substr(kind, 1)) {
            complaints.push_back(
                complaintAt(token, "\"" + std::string{token.text} + "\" closes nothing"));
            return;
        }
        open.pop_back();
    }
    if (open.empty()) return;
    complaints.push_back(
        complaintAt(*open.back(), "\"" + std::string{open.back()->text} + "\" is not closed"));
}

/// Sizes that are written as numbers; computed ones are seen in the tree.
void checkArrayLengths(const std::vector<Token>& tokens, std::vector<Complaint>& complaints) {
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        if (token.kind != Token::Kind::kNumber || !tokens[i - 1].is("[")) continue;
        unsigned long length = 0;
        const char* end = token.text.data() + token.text.size();
        const bool fits = std::from_chars(token.text.data(), end, length).ec == std::errc{};
        if (fits && length <= kMaxArrayLength) continue;
        complaints.push_back(complaintAt(token, "[" + std::string{token.text} +
                                                    "]: an array has at most " +
                                                    std::to_string(kMaxArrayLength) + " elements"));
    }
}

/// Whether a name of the user's is to get the prefix.
class Renaming {
public:
    explicit Renaming(const std::vector<Token>& tokens) : tokens_{tokens} {}

    /// Must be asked of all tokens in order.
    bool applies(std::size_t i) {
        const Token& token = tokens_[i];
        follow(i);
        if (token.kind != Token::Kind::kWord) return false;
        const Word kind = wordKind(token.text);
        if (i > 0 && tokens_[i - 1].is(".")) return !isSelector(token.text);
        const bool called = i + 1 < tokens_.size() && tokens_[i + 1].is("(");
        if (kind == Word::kFunction) return !called && !(inMembers() && isSelector(token.text));
        // uint8_t and the like: glslang keeps them for extensions of its own.
        if (kind == Word::kOffered && token.text.ends_with("_t")) return true;
        if (kind != Word::kOther) return false;
        return !(inMembers() && isSelector(token.text));
    }

private:
    [[nodiscard]] bool inMembers() const { return inStruct_ && brackets_ == 0; }

    void follow(std::size_t i) {
        if (i >= 2 && tokens_[i].is("{") && tokens_[i - 2].is("struct")) inStruct_ = true;
        if (tokens_[i].is("}")) inStruct_ = false;
        brackets_ += tokens_[i].is("[") ? 1 : tokens_[i].is("]") ? -1 : 0;
    }

    const std::vector<Token>& tokens_;
    bool inStruct_ = false;
    int brackets_ = 0;
};

std::string renamed(const std::vector<Token>& tokens) {
    std::string text;
    int line = 1;
    Renaming renaming{tokens};
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        for (; line < tokens[i].line; ++line) text += '\n';
        if (renaming.applies(i)) text += kPrefix;
        text.append(tokens[i].text) += ' ';
    }
    return text += '\n';
}

void findChannels(const std::vector<Token>& tokens, Checked& checked) {
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
        const bool reads = tokens[i].is("getDataValue") || tokens[i].is("getInterpolatedDataValue");
        const Token& argument = tokens[i + 2];
        if (!reads || argument.is(")")) continue;
        int channel = 0;
        const char* end = argument.text.data() + argument.text.size();
        const bool number = tokens[i + 3].is(")") &&
                            std::from_chars(argument.text.data(), end, channel).ec == std::errc{};
        if (number) {
            checked.channels.insert(channel);
        } else {
            checked.readsAnyChannel = true;
        }
    }
}

}  // namespace

Checked checkText(std::string_view code) {
    Checked checked;
    if (code.size() > kMaxCodeBytes) {
        checked.complaints.push_back({.message = std::to_string(code.size()) +
                                                 " bytes of code, at most " +
                                                 std::to_string(kMaxCodeBytes)});
        return checked;
    }
    Parsed parsed = parse(code);
    std::vector<Complaint>& complaints = checked.complaints;
    complaints = std::move(parsed.complaints);
    checked.controls = std::move(parsed.controls);
    const std::vector<Token> tokens = tokensOf(parsed.body, complaints);
    const auto words = std::ranges::count(tokens, Token::Kind::kWord, &Token::kind);
    if (static_cast<std::size_t>(words) > kMaxWords) {
        complaints.push_back(
            {.message = std::to_string(words) + " words, at most " + std::to_string(kMaxWords)});
    }
    checkBrackets(tokens, complaints);
    checkArrayLengths(tokens, complaints);
    checkControlNames(checked.controls, complaints);
    const Declared declared = declaredBy(tokens, complaints);
    // A control with an error is not known, so that its uses would be complained of, too.
    if (complaints.empty()) checkWords(tokens, declared, checked.controls, complaints);
    std::ranges::stable_sort(complaints, {}, &Complaint::line);
    findChannels(tokens, checked);
    checked.body = renamed(tokens);
    return checked;
}

}  // namespace volcast::user_shader
