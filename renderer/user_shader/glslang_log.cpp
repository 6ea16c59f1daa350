#include "renderer/user_shader/glslang_log.h"

#include <regex>
#include <string>

namespace volcast::user_shader {

std::string withoutPrefix(std::string_view text) {
    static const std::regex kName{R"(\buser(\w+))"};
    return std::regex_replace(std::string{text}, kName, "$1");
}

std::vector<Complaint> complaintsOfLog(std::string_view log,
                                       const std::function<int(int)>& userLine) {
    // "ERROR: 0:12: 'name' : what is wrong"
    static const std::regex kError{R"(ERROR: 0:(\d{1,9}): ([^\n]*))"};
    const std::string text{log};
    std::vector<Complaint> complaints;
    std::string elsewhere;
    for (std::sregex_iterator match{text.begin(), text.end(), kError}, end; match != end; ++match) {
        const int line = userLine(std::stoi((*match)[1].str()));
        std::string message = withoutPrefix((*match)[2].str());
        message.erase(message.find_last_not_of(' ') + 1);
        // What follows in a line follows from its first error.
        const bool known = !complaints.empty() && complaints.back().line == line;
        if (known) continue;
        if (line > 0) {
            complaints.push_back({.line = line, .message = message});
        } else if (elsewhere.empty()) {
            elsewhere = message;
        }
    }
    if (complaints.empty()) {
        complaints.push_back({.message = elsewhere.empty() ? "is not GLSL" : elsewhere});
    }
    return complaints;
}

}  // namespace volcast::user_shader
