#include "renderer/user_shader/directive.h"

#include <algorithm>
#include <cctype>

namespace volcast::user_shader {
namespace {

namespace json = boost::json;

constexpr const char* kSyntax =
    "Invalid #uicontrol syntax, expected: #uicontrol <type> <name> <control>(<param>=<value>, "
    "...)";
constexpr const char* kParameterSyntax =
    "Invalid #uicontrol parameter syntax, expected: <param>=<value>, ...";
constexpr std::string_view kWord = "uicontrol";

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Reads one line from left to right.
class Reader {
public:
    Reader(std::string_view text, int line, std::vector<Complaint>& complaints)
        : text_{text}, complaints_{complaints} {
        directive_.line = line;
    }

    Directive read() {
        skipBlanks();
        ++at_;  // '#'
        skipBlanks();
        at_ += kWord.size();
        if (head()) body();
        return std::move(directive_);
    }

private:
    [[nodiscard]] int column() const { return static_cast<int>(at_) + 1; }
    [[nodiscard]] bool atEnd() const { return at_ == text_.size(); }
    [[nodiscard]] char next() const { return atEnd() ? '\0' : text_[at_]; }

    void skipBlanks() {
        while (next() == ' ' || next() == '\t' || next() == '\r') ++at_;
    }

    bool complain(int column, std::string message) {
        complaints_.push_back(
            {.line = directive_.line, .column = column, .message = std::move(message)});
        return false;
    }

    std::string word() {
        const std::size_t begin = at_;
        while (isWord(next())) ++at_;
        return std::string{text_.substr(begin, at_ - begin)};
    }

    bool head() {
        skipBlanks();
        directive_.typeColumn = column();
        directive_.type = word();
        skipBlanks();
        directive_.nameColumn = column();
        directive_.name = word();
        const char* const why = headComplaint();
        if (why != nullptr) {
            const bool byName = !directive_.type.empty() && !startsWithDigit(directive_.type);
            return complain(byName ? directive_.nameColumn : directive_.typeColumn,
                            std::string{kSyntax} + why);
        }
        skipBlanks();
        directive_.controlColumn = column();
        directive_.control = word();
        if (directive_.control.empty()) {
            directive_.control = directive_.type;
            directive_.controlColumn = directive_.typeColumn;
        }
        return true;
    }

    static bool startsWithDigit(const std::string& text) {
        return std::isdigit(static_cast<unsigned char>(text.front())) != 0;
    }

    [[nodiscard]] const char* headComplaint() const {
        if (directive_.type.empty()) return "; there is no type";
        if (startsWithDigit(directive_.type)) return "; a type does not begin with a digit";
        if (directive_.name.empty()) return "; there is no name";
        if (std::islower(static_cast<unsigned char>(directive_.name.front())) == 0) {
            return "; a name begins with a lower-case letter";
        }
        return nullptr;
    }

    void body() {
        skipBlanks();
        if (atEnd()) return;
        if (next() != '(') {
            complain(column(), std::string{kSyntax} + "; found \"" +
                                   std::string{text_.substr(at_)} + R"(" before any "(")");
            return;
        }
        const int open = column();
        ++at_;
        for (skipBlanks(); next() != ')'; skipBlanks()) {
            if (atEnd()) {
                complain(open, std::string{kSyntax} + "; the \"(\" is not closed in its line");
                return;
            }
            if (!parameter()) return;
        }
        ++at_;
        skipBlanks();
        if (atEnd()) return;
        complain(column(), std::string{kSyntax} + "; found \"" + std::string{text_.substr(at_)} +
                               "\" after the \")\"");
    }

    bool parameter() {
        Parameter parameter;
        parameter.column = column();
        parameter.name = word();
        skipBlanks();
        if (parameter.name.empty() || startsWithDigit(parameter.name) || next() != '=') {
            return complain(parameter.column, kParameterSyntax);
        }
        ++at_;
        skipBlanks();
        parameter.valueColumn = column();
        if (!value(parameter)) return false;
        skipBlanks();
        if (next() == ',') {
            ++at_;
        } else if (next() != ')' && !atEnd()) {
            return complain(column(), kParameterSyntax);
        }
        const bool twice = std::ranges::find(directive_.parameters, parameter.name,
                                             &Parameter::name) != directive_.parameters.end();
        if (twice) {
            complain(parameter.column, "Duplicate #uicontrol parameter: " + parameter.name);
        } else {
            directive_.parameters.push_back(std::move(parameter));
        }
        return true;
    }

    /// One JSON value; what follows it is left.
    bool value(Parameter& parameter) {
        json::stream_parser parser;
        json::error_code error;
        // A number ends where no more of it follows, so the parser has to see that.
        const std::size_t used = parser.write_some(text_.data() + at_, text_.size() - at_, error);
        if (!error && !parser.done()) parser.finish(error);
        if (error) {
            return complain(parameter.valueColumn + static_cast<int>(used),
                            "Invalid #uicontrol parameter value for " + parameter.name + ": " +
                                error.message());
        }
        at_ += used;
        parameter.value = parser.release();
        if (holdsNull(parameter.value)) {
            return complain(parameter.valueColumn, "Invalid #uicontrol parameter value for " +
                                                       parameter.name + ": null has no meaning");
        }
        return true;
    }

    static bool holdsNull(const json::value& value) {
        if (value.is_null()) return true;
        if (const json::array* items = value.if_array()) {
            return std::ranges::any_of(*items, holdsNull);
        }
        const json::object* object = value.if_object();
        return object != nullptr && std::ranges::any_of(*object, [](const auto& entry) {
                   return holdsNull(entry.value());
               });
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Complaint>& complaints_;
    Directive directive_;
};

}  // namespace

bool isUiControl(std::string_view line) {
    const auto blanks = [&line] {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    };
    blanks();
    if (!line.starts_with('#')) return false;
    line.remove_prefix(1);
    blanks();
    return line.starts_with(kWord) && (line.size() == kWord.size() || !isWord(line[kWord.size()]));
}

Directive readDirective(std::string_view text, int line, std::vector<Complaint>& complaints) {
    return Reader{text, line, complaints}.read();
}

}  // namespace volcast::user_shader
