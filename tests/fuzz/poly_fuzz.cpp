// A .poly or .smesh file and, behind a byte 1, the .node file beside it.
#include "renderer/data/load/surface_files.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = fuzz::textOf(data, size);
    const auto cut = std::min(text.find('\x01'), text.size());
    const auto nodes = cut < text.size() ? text.substr(cut + 1) : std::string_view{};
    (void)data::load::parsePoly("fuzz.poly", text.substr(0, cut), nodes);
    (void)data::load::parsePoly("fuzz.smesh", text.substr(0, cut), nodes);
    return 0;
}
