#include "renderer/base/printable.h"

#include <algorithm>

namespace volcast::base {

std::string printable(std::string_view text, std::size_t most) {
    std::string line{text.substr(0, most)};
    std::ranges::replace_if(
        line,
        [](char c) {
            const auto byte = static_cast<unsigned char>(c);
            return byte < 0x20 || byte == 0x7f || c == '"' || c == '\\';
        },
        '?');
    return line;
}

}  // namespace volcast::base
