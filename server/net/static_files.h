#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::net {

/// One file of the web client, as it is answered.
struct StaticFile {
    std::string content;
    std::string mimeType;
    std::string etag;          ///< Quoted, of size and time.
    std::string cacheControl;  ///< Hashed assets for ever, all else revalidated.
};

/// The built web client: files below one folder, nothing else of the machine.
class StaticFiles {
public:
    static constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20U;

    /// A folder that does not exist is fine: it may be built later.
    explicit StaticFiles(std::string folder) : folder_{std::move(folder)} {}

    /// The file for a request target such as "/assets/index-1f2e.js?x"; "/" is index.html.
    ///
    /// Errors: kInvalidArgument (not a path, a bad escape), kNotFound (also for every way out of
    /// the folder, links included), kLimitExceeded, kIo.
    [[nodiscard]] Result<StaticFile> read(std::string_view target) const;

    /// True where the client has been built.
    [[nodiscard]] bool built() const;
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }

private:
    std::string folder_;
};

/// The path of a request target, unescaped, relative; empty for "/".
///
/// Errors: kInvalidArgument.
Result<std::string> pathOf(std::string_view target);

/// By extension; "application/octet-stream" for what is not known.
std::string mimeTypeOf(std::string_view path);

}  // namespace volcast::net
