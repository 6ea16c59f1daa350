#include "renderer/user_shader/parse.h"

#include <algorithm>

#include "renderer/user_shader/comments.h"
#include "renderer/user_shader/declare.h"
#include "renderer/user_shader/directive.h"

namespace volcast::user_shader {
namespace {

void addControl(Parsed& parsed, const Directive& directive) {
    std::optional<Control> control = declare(directive, parsed.complaints);
    if (!control) return;
    const auto complain = [&](std::string message) {
        parsed.complaints.push_back({.line = directive.line,
                                     .column = directive.nameColumn,
                                     .message = std::move(message)});
    };
    const auto first = std::ranges::find(parsed.controls, control->name, &Control::name);
    if (first != parsed.controls.end()) {
        complain("Duplicate definition for control " + control->name + "; the first is in line " +
                 std::to_string(first->line));
    } else if (parsed.controls.size() == kMaxControls) {
        complain("more than " + std::to_string(kMaxControls) + " controls");
    } else {
        parsed.controls.push_back(std::move(*control));
    }
}

}  // namespace

Parsed parse(std::string_view code) {
    Parsed parsed;
    const std::string text = withoutComments(code);
    std::string_view rest = text;
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        if (isUiControl(line)) {
            const std::size_t before = parsed.complaints.size();
            const Directive directive = readDirective(line, number, parsed.complaints);
            if (parsed.complaints.size() == before) addControl(parsed, directive);
        } else {
            parsed.body += line;
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
        parsed.body += '\n';
    }
    return parsed;
}

}  // namespace volcast::user_shader
