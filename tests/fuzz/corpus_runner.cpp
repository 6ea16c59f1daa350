// Runs a target over files, each also cut at every place and with single bytes changed: a smoke
// test in any build. Usage: fuzz_NAME FOLDER
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

/// Cuts and changes of long files are spread over them, so that a run stays short.
constexpr std::size_t kMostPlaces = 400;

int runOne(const std::string& input) {
    return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()),
                                  input.size());
}

std::size_t runVariants(const std::string& input) {
    std::size_t runs = 1;
    runOne(input);
    const std::size_t step = std::max<std::size_t>(1, input.size() / kMostPlaces);
    for (std::size_t at = 0; at < input.size(); at += step) {
        runOne(input.substr(0, at));
        for (const char byte : {'\0', '\xff', '-', '9'}) {
            std::string changed = input;
            changed[at] = byte;
            runOne(changed);
        }
        runs += 5;
    }
    return runs;
}

int run(int argc, char** argv) {
    std::size_t files = 0, runs = 0;
    for (int i = 1; i < argc; ++i) {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::directory_iterator{argv[i]}) {
            paths.push_back(entry.path());
        }
        std::ranges::sort(paths);
        for (const auto& path : paths) {
            std::ifstream file{path, std::ios::binary};
            runs += runVariants({std::istreambuf_iterator<char>{file}, {}});
            ++files;
        }
    }
    std::printf("%zu inputs from %zu files\n", runs, files);
    return files > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
