// A transfer function's file: lines or JSON. What is taken ascends and is finite.
#include <cmath>

#include "server/commands/map_file.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const commands::MapUsual usual{.window = {.min = -1.0F, .max = 3.0F}, .distance = 2.0};
    const auto map = commands::parseMap(fuzz::textOf(data, size), usual);
    if (!map) return 0;
    for (std::size_t i = 0; i < map->points.size(); ++i) {
        fuzz::require(std::isfinite(map->points[i].value));
        fuzz::require(i == 0 || map->points[i].value >= map->points[i - 1].value);
    }
    return 0;
}
