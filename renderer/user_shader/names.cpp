#include "renderer/user_shader/names.h"

#include <algorithm>
#include <string>

#include "renderer/user_shader/words.h"

namespace volcast::user_shader {
namespace {

void complain(std::vector<Complaint>& complaints, const Token& token, std::string message) {
    complaints.push_back(
        {.line = token.line, .column = token.column, .message = std::move(message)});
}

bool isFunctionLike(const Control& control) {
    return std::holds_alternative<InvLerp>(control.kind) ||
           std::holds_alternative<TransferFunction>(control.kind);
}

bool isTypeName(const Token& token, const Declared& declared) {
    const Word kind = wordKind(token.text);
    const bool offered = token.text.ends_with("_t");
    return kind == Word::kType || (kind == Word::kOffered && offered) ||
           declared.structs.contains(token.text);
}

void declareFunction(const Token& name, Declared& declared, std::vector<Complaint>& complaints) {
    const Word kind = wordKind(name.text);
    if (kind == Word::kFunction || kind == Word::kOffered) {
        complain(
            complaints, name,
            std::string{name.text} + " is a function that is there already; choose another name");
    }
    declared.functions.insert(name.text);
}

bool callable(const Token& name, const Declared& declared, const std::vector<Control>& controls) {
    if (declared.functions.contains(name.text) || declared.structs.contains(name.text)) return true;
    const auto control = std::ranges::find(controls, name.text, &Control::name);
    return control != controls.end() && isFunctionLike(*control);
}

std::string notCallable(const Token& name, const std::vector<Control>& controls) {
    const auto control = std::ranges::find(controls, name.text, &Control::name);
    if (control == controls.end()) return "there is no function " + std::string{name.text};
    return control->name + " is a value of the control " + kindName(*control) + ", not a function";
}

}  // namespace

Declared declaredBy(const std::vector<Token>& tokens, std::vector<Complaint>& complaints) {
    Declared declared;
    int depth = 0;
    bool hasMain = false;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].is("{")) ++depth;
        if (tokens[i].is("}")) --depth;
        const bool named = i + 2 < tokens.size() && tokens[i + 1].kind == Token::Kind::kWord;
        if (depth != 0 || !named) continue;
        if (tokens[i].is("struct") && tokens[i + 2].is("{")) {
            declared.structs.insert(tokens[i + 1].text);
        }
        if (isTypeName(tokens[i], declared) && tokens[i + 2].is("(")) {
            declareFunction(tokens[i + 1], declared, complaints);
            const bool isMain = tokens[i].is("void") && tokens[i + 1].is("main") &&
                                i + 4 < tokens.size() && tokens[i + 3].is(")") &&
                                tokens[i + 4].is("{");
            if (isMain && hasMain) complain(complaints, tokens[i + 1], "main() is defined twice");
            hasMain = hasMain || isMain;
        }
    }
    if (!hasMain) complaints.push_back({.message = "there is no void main() { ... }"});
    return declared;
}

void checkWords(const std::vector<Token>& tokens, const Declared& declared,
                const std::vector<Control>& controls, std::vector<Complaint>& complaints) {
    int parentheses = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        parentheses += token.is("(") ? 1 : token.is(")") ? -1 : 0;
        if (token.kind == Token::Kind::kNumber &&
            (token.text.ends_with("lf") || token.text.ends_with("LF"))) {
            complain(complaints, token,
                     std::string{token.text} + ": numbers have single precision");
        }
        if (token.kind != Token::Kind::kWord) continue;
        const std::string word{token.text};
        const Word kind = wordKind(token.text);
        const bool called = i + 1 < tokens.size() && tokens[i + 1].is("(");
        const bool selects = i > 0 && tokens[i - 1].is(".");
        if (kind == Word::kRefused) {
            complain(complaints, token,
                     word + " is not allowed: " + std::string{refusalOf(token.text)});
        } else if (parentheses == 0 && (word == "in" || word == "out" || word == "inout")) {
            complain(complaints, token, word + " is for the parameters of functions alone");
        } else if (kind == Word::kOffered && !called && !word.ends_with("_t") &&
                   word != "VOLUME_RENDERING") {
            complain(complaints, token, word + " is a function; call it, or choose another name");
        } else if (kind == Word::kOther && called && !selects &&
                   !callable(token, declared, controls)) {
            complain(complaints, token, notCallable(token, controls));
        }
    }
}

void checkControlNames(const std::vector<Control>& controls, std::vector<Complaint>& complaints) {
    for (const Control& control : controls) {
        const Word kind = wordKind(control.name);
        const bool taken =
            kind != Word::kOther && !(kind == Word::kFunction && !isFunctionLike(control));
        if (!taken && control.name != "main") continue;
        complaints.push_back({.line = control.line,
                              .message = "the control " + control.name +
                                         " has a name with a meaning of its own; choose another"});
    }
}

}  // namespace volcast::user_shader
