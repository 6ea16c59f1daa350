#include "server/workers/gpu_given_up.h"

#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <system_error>

#include "renderer/base/printable.h"

namespace volcast::workers {

namespace {

constexpr std::size_t kMostCharacters = 400;

std::filesystem::path noteIn(const std::string& cacheFolder) {
    return std::filesystem::path{cacheFolder} / "gpu_given_up.txt";
}

}  // namespace

void noteGpuGivenUp(const std::string& cacheFolder, const std::string& why) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    // A note that cannot be written is in the log all the same.
    std::ofstream{noteIn(cacheFolder)} << std::put_time(&utc, "%Y-%m-%dT%H:%M:%SZ: ") << why
                                       << '\n';
}

std::string gpuGivenUp(const std::string& cacheFolder) {
    if (cacheFolder.empty()) return {};
    std::ifstream note{noteIn(cacheFolder)};
    std::string line;
    std::getline(note, line);
    return base::printable(line, kMostCharacters);  // Workers may write to that folder, too.
}

void forgetGpuGivenUp(const std::string& cacheFolder) {
    if (cacheFolder.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(noteIn(cacheFolder), ignored);
}

}  // namespace volcast::workers
