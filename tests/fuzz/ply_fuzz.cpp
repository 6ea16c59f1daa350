// A surface as .ply, in text and binary.
#include "renderer/data/load/surface_files.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> warnings;
    (void)data::load::parsePly("fuzz.ply", fuzz::textOf(data, size), warnings);
    return 0;
}
