// A user's code: comments, directives, words, brackets, names. Complaints name lines that exist.
#include <algorithm>

#include "renderer/user_shader/check_text.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto code = fuzz::textOf(data, size);
    const auto checked = user_shader::checkText(code);
    const auto lines = static_cast<std::size_t>(std::ranges::count(code, '\n')) + 1;
    for (const user_shader::Complaint& complaint : checked.complaints) {
        fuzz::require(complaint.line >= 1 && static_cast<std::size_t>(complaint.line) <= lines);
    }
    return 0;
}
