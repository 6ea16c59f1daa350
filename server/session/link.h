#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// The secret that links, access tokens and saved resume tokens are signed with.
class LinkKey {
public:
    static constexpr std::size_t kBytes = 32;

    /// Of this run of the server alone. Errors: kIo where the system gives no random bytes.
    static Result<LinkKey> random();
    /// The key in `path`, kBytes in hexadecimal; a file that does not exist is made, readable by
    /// its owner only.
    ///
    /// Errors: kIo (not readable, cannot be made), kInvalidArgument (not a key, or others may read
    /// it).
    static Result<LinkKey> fromFile(const std::string& path);

    using Signature = std::array<std::byte, 32>;
    /// HMAC-SHA256. `purpose` keeps what is signed for one thing from passing as another.
    [[nodiscard]] Signature sign(const std::string& purpose, const std::string& bytes) const;

private:
    [[nodiscard]] Result<bool> keep(const std::string& path) const;

    std::array<std::byte, kBytes> bytes_{};
};

/// What a link allows: to join one view in one role, until a time.
struct Link {
    std::string view;
    v1::Role role = v1::ROLE_WATCH;
    std::chrono::system_clock::time_point expires{};  ///< Whole seconds.
};

/// `link` with a nonce, signed; base64url.
Result<std::string> signLink(const Link& link, const LinkKey& key);

/// Errors: kInvalidArgument for anything that `key` did not sign as it is, and for what has expired
/// at `now`.
Result<Link> readLink(const std::string& text, const LinkKey& key,
                      std::chrono::system_clock::time_point now);

/// What an access token says of who brings it, until a time. ROLE_CONTROL: may change what the
/// server holds, as by uploads; ROLE_WATCH: may look at it.
struct Access {
    v1::Role role = v1::ROLE_WATCH;
    std::chrono::system_clock::time_point expires{};  ///< Whole seconds.
};

/// `access` with a nonce, signed; base64url. No link passes as one, nor the other way round.
Result<std::string> signAccess(const Access& access, const LinkKey& key);

/// Errors: as readLink().
Result<Access> readAccess(const std::string& text, const LinkKey& key,
                          std::chrono::system_clock::time_point now);

/// So many random bytes, base64url. Errors: kIo.
Result<std::string> randomName(std::size_t bytes);

/// Base64url without padding (RFC 4648, section 5).
std::string base64Url(const std::string& bytes);

}  // namespace volcast::session
