// A surface as .stl.
#include "renderer/data/load/surface_files.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    (void)data::load::parseStl("fuzz.stl", fuzz::textOf(data, size));
    return 0;
}
