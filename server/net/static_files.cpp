#include "server/net/static_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "renderer/base/file_descriptor.h"
#include "server/session/beneath.h"
#include "server/video/gzip.h"

namespace volcast::net {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kMimeTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".md", "text/plain; charset=utf-8"},
}};

/// What this compresses: pictures and fonts are compressed already.
constexpr std::array<std::string_view, 10> kTexts{".html", ".js",  ".mjs",         ".css", ".json",
                                                  ".map",  ".svg", ".webmanifest", ".txt", ".md"};
constexpr std::size_t kMostGzipped = 512;  ///< Files kept; a built client has some dozens.
constexpr std::size_t kMaxGzipBytes = std::size_t{8} << 20U;

bool isText(std::string_view path) {
    return std::ranges::any_of(kTexts, [&](std::string_view end) { return path.ends_with(end); });
}

std::string hex(std::uint64_t value) {
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    return {digits.data(), end};
}

Result<std::string> readAll(int fd, std::size_t size, const std::string& path) {
    std::string content(size, '\0');
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(fd, content.data() + done, size - done);
        if (got < 0) return fail(ErrorCode::kIo, path + ": cannot be read");
        if (got == 0) break;  // It shrank while being read; the length we have is what is sent.
        done += static_cast<std::size_t>(got);
    }
    content.resize(done);
    return content;
}

}  // namespace

std::string mimeTypeOf(std::string_view path) {
    for (const auto& [extension, type] : kMimeTypes) {
        if (path.ends_with(extension)) return std::string{type};
    }
    return "application/octet-stream";
}

Result<std::string> pathOf(std::string_view target) {
    const auto refuse = [] {
        return fail(ErrorCode::kInvalidArgument, "the request target is not a path");
    };
    target = target.substr(0, target.find_first_of("?#"));
    if (!target.starts_with('/')) return refuse();
    target.remove_prefix(1);
    std::string path;
    for (std::size_t i = 0; i < target.size(); ++i) {
        unsigned byte = static_cast<unsigned char>(target[i]);
        if (target[i] == '%') {
            const std::string_view digits = target.substr(i + 1, 2);
            const auto read =
                std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
            if (digits.size() != 2 || read.ptr != digits.data() + 2) return refuse();
            i += 2;
        }
        if (byte < 0x20 || byte == 0x7f) return refuse();
        path += static_cast<char>(byte);
    }
    return path;
}

Result<StaticFile> StaticFiles::read(std::string_view target, bool gzip) const {
    auto path = pathOf(target);
    if (!path) return path.error();
    if (path->empty()) *path = "index.html";
    const auto root = session::openFolder(folder_);
    if (!root) return root.error();
    const auto file = session::openBeneath(*root, *path, session::Links::kRefuse);
    if (!file) return file.error();
    struct stat status {};
    if (::fstat(file->get(), &status) != 0) return fail(ErrorCode::kIo, *path + ": no status");
    if (!S_ISREG(status.st_mode)) return fail(ErrorCode::kNotFound, *path + ": not a file");
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > kMaxFileBytes) return fail(ErrorCode::kLimitExceeded, *path + ": too large");
    auto content = readAll(file->get(), size, *path);
    if (!content) return content.error();
    const auto time = static_cast<std::uint64_t>(status.st_mtim.tv_sec) * 1'000'000'000 +
                      static_cast<std::uint64_t>(status.st_mtim.tv_nsec);
    const bool hashed = path->starts_with("assets/");
    StaticFile answer;
    answer.content = std::move(*content);
    answer.mimeType = mimeTypeOf(*path);
    answer.cacheControl = hashed ? "public, max-age=31536000, immutable" : "no-cache";
    answer.varies = isText(*path) && size <= kMaxGzipBytes;
    const std::string version = hex(size) + '-' + hex(time);
    if (gzip && answer.varies) {
        if (const Gzipped small = gzipped(*path + ' ' + version, answer.content)) {
            answer.content = *small;
            answer.gzipped = true;
        }
    }
    answer.etag = '"' + version + (answer.gzipped ? "-gz\"" : "\"");
    return answer;
}

StaticFiles::Gzipped StaticFiles::gzipped(const std::string& name,
                                          const std::string& content) const {
    const std::lock_guard lock{mutex_};  // Also so that nobody compresses the same twice.
    const auto found = gzipped_.find(name);
    if (found != gzipped_.end()) return found->second;
    if (gzipped_.size() >= kMostGzipped) gzipped_.clear();  // Versions that were built over.
    auto packed = video::gzip(content);
    const bool smaller = packed && packed->size() < content.size();
    Gzipped kept = smaller ? std::make_shared<const std::string>(std::move(*packed)) : nullptr;
    gzipped_.emplace(name, kept);
    return kept;
}

bool StaticFiles::built() const {
    std::error_code ignored;
    return std::filesystem::is_regular_file(folder_ + "/index.html", ignored);
}

}  // namespace volcast::net
