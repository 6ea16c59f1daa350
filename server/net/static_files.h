#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "renderer/base/result.h"

namespace volcast::net {

/// One file of the web client, as it is answered.
struct StaticFile {
    std::string content;
    std::string mimeType;
    std::string etag;          ///< Quoted, of size and time.
    std::string cacheControl;  ///< Hashed assets for ever, all else revalidated.
    bool gzipped = false;      ///< `content` is a gzip file; the etag says so, too.
    bool varies = false;       ///< There is another answer for those who take or do not take gzip.
};

/// The built web client: files below one folder, nothing else of the machine.
class StaticFiles {
public:
    static constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20U;

    /// A folder that does not exist is fine: it may be built later.
    explicit StaticFiles(std::string folder) : folder_{std::move(folder)} {}

    /// The file for a request target such as "/assets/index-1f2e.js?x"; "/" is index.html. Text is
    /// compressed for who takes that: once, and kept in memory.
    ///
    /// Errors: kInvalidArgument (not a path, a bad escape), kNotFound (also for every way out of
    /// the folder, links included), kLimitExceeded, kIo.
    [[nodiscard]] Result<StaticFile> read(std::string_view target, bool gzip = false) const;

    /// True where the client has been built.
    [[nodiscard]] bool built() const;
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }

private:
    /// As it was compressed; null where it is larger so.
    using Gzipped = std::shared_ptr<const std::string>;
    /// `name`: of this version of the file.
    [[nodiscard]] Gzipped gzipped(const std::string& name, const std::string& content) const;

    std::string folder_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, Gzipped> gzipped_;
};

/// The path of a request target, unescaped, relative; empty for "/".
///
/// Errors: kInvalidArgument.
Result<std::string> pathOf(std::string_view target);

/// By extension; "application/octet-stream" for what is not known.
std::string mimeTypeOf(std::string_view path);

}  // namespace volcast::net
