// Points of a .node file.
#include "renderer/data/load/node_file.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    data::load::TextLines lines{"fuzz.node", fuzz::textOf(data, size)};
    (void)data::load::readNodes(lines);
    return 0;
}
