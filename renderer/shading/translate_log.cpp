#include <regex>

#include "renderer/shading/assemble.h"

namespace volcast::shading {

// Forms met: Mesa "0:12(5): error", NVIDIA "0(12) : error", others "ERROR: 0:12: ".
std::string Assembled::translate(std::string_view driverLog) const {
    static const std::regex kPlace{R"(\b0(?::(\d+)(?:\(\d+\))?|\((\d+)\) ?):)"};
    const std::string log{driverLog};
    std::string translated;
    auto rest = log.cbegin();
    for (std::sregex_iterator match{log.begin(), log.end(), kPlace}, end; match != end; ++match) {
        const std::string digits = (*match)[1].matched ? (*match)[1].str() : (*match)[2].str();
        const unsigned long line = digits.size() > 9 ? 0 : std::stoul(digits);
        translated.append(rest, (*match)[0].first);
        if (line >= 1 && line <= lines.size()) {
            const LineOrigin& origin = lines[line - 1];
            translated += origin.file + ":" + std::to_string(origin.line) + ":";
        } else {
            translated += match->str();
        }
        rest = (*match)[0].second;
    }
    return translated.append(rest, log.cend());
}

}  // namespace volcast::shading
