#include "server/workers/gpu_given_up.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/printable.h"

namespace volcast::workers {

namespace {

constexpr std::size_t kMostCharacters = 400;
constexpr std::size_t kMostBytesRead = 4096;

// Workers may write to that folder, too: whatever lies there may be theirs, a link to a file of the
// user's among it. So nothing there is followed, written into or waited for.
std::filesystem::path noteIn(const std::string& cacheFolder) {
    return std::filesystem::path{cacheFolder} / "gpu_given_up.txt";
}

}  // namespace

void noteGpuGivenUp(const std::string& cacheFolder, const std::string& why) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::ostringstream line;
    line << std::put_time(&utc, "%Y-%m-%dT%H:%M:%SZ: ") << why << '\n';
    const std::string text = line.str();
    const std::string note = noteIn(cacheFolder);
    std::string fresh = note + ".XXXXXX";
    // O_EXCL is of mkostemp: a file that was not there before. One that cannot be written is in
    // the log all the same.
    const base::FileDescriptor file{::mkostemp(fresh.data(), O_CLOEXEC)};
    if (!file.valid()) return;
    const bool written =
        ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (!written || ::rename(fresh.c_str(), note.c_str()) != 0) ::unlink(fresh.c_str());
}

std::string gpuGivenUp(const std::string& cacheFolder) {
    if (cacheFolder.empty()) return {};
    const base::FileDescriptor file{
        ::open(noteIn(cacheFolder).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    struct stat info {};
    if (!file.valid() || ::fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode)) return {};
    std::string text(kMostBytesRead, '\0');
    const ssize_t size = ::read(file.get(), text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return base::printable(text.substr(0, text.find('\n')), kMostCharacters);
}

void forgetGpuGivenUp(const std::string& cacheFolder) {
    if (cacheFolder.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(noteIn(cacheFolder), ignored);
}

}  // namespace volcast::workers
