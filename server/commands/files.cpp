#include "server/commands/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <unistd.h>

namespace volcast::commands {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextFile = std::size_t{16} << 20;

struct FileCloser {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

Error failed(const std::string& path, const char* what) {
    return fail(ErrorCode::kIo, path + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

Result<std::string> readTextFile(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return fail(ErrorCode::kIo, path + ": is a folder");
    const File file{std::fopen(path.c_str(), "rbe")};
    if (!file) return failed(path, "cannot be read");
    std::string text(kMaxTextFile + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    if (std::ferror(file.get()) != 0) return failed(path, "cannot be read");
    if (text.size() > kMaxTextFile) {
        return fail(ErrorCode::kLimitExceeded,
                    path + ": has more than " + std::to_string(kMaxTextFile) + " bytes");
    }
    return text;
}

Result<void> checkWritable(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return fail(ErrorCode::kIo, path + ": is a folder");
    const fs::path folder = fs::path{path}.has_parent_path() ? fs::path{path}.parent_path() : ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0) return failed(path, "cannot be written");
    return {};
}

Result<void> writeFile(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    const fs::file_status now = fs::status(path, error);
    // Pipes and devices are written to; a file is replaced.
    const bool replace = !fs::exists(now) || fs::is_regular_file(now);
    const std::string target = replace ? path + ".part" + std::to_string(::getpid()) : path;
    std::FILE* file = std::fopen(target.c_str(), "wbe");
    if (file == nullptr) return failed(path, "cannot be written");
    bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    whole = std::fclose(file) == 0 && whole;
    if (whole && (!replace || std::rename(target.c_str(), path.c_str()) == 0)) return {};
    Error failure = failed(path, "cannot be written");
    if (replace) static_cast<void>(std::remove(target.c_str()));
    return failure;
}

}  // namespace volcast::commands
