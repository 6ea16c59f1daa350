#include "renderer/data/load/file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::data::load {

namespace {

Error systemError(const std::string& path) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo;
    return fail(code, path + ": " + std::strerror(errno));
}

}  // namespace

Result<std::string> readFile(const std::string& path, std::uint64_t maxBytes) {
    // Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
    const base::FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (!file.valid()) return systemError(path);
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) return systemError(path);
    if (!S_ISREG(info.st_mode)) {
        return fail(ErrorCode::kInvalidArgument, path + ": is not a plain file");
    }
    const auto size = static_cast<std::uint64_t>(info.st_size);
    if (size == 0) return fail(ErrorCode::kInvalidArgument, path + ": is empty");
    if (size > maxBytes) {
        return fail(ErrorCode::kLimitExceeded, path + ": has " + std::to_string(size) +
                                                   " bytes, more than the " +
                                                   std::to_string(maxBytes) + " allowed");
    }
    std::string content(size, '\0');
    std::size_t done = 0;
    while (done < content.size()) {
        const ssize_t got = ::read(file.get(), content.data() + done, content.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return systemError(path);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    content.resize(done);
    return content;
}

bool exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

std::string withSuffix(const std::string& path, const std::string& suffix) {
    return std::filesystem::path{path}.replace_extension(suffix).string();
}

}  // namespace volcast::data::load
