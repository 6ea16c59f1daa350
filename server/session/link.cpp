#include "server/session/link.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <span>
#include <sys/stat.h>
#include <unistd.h>

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::session {

namespace {

constexpr char kVersion = 1;
constexpr std::size_t kNonceBytes = 16;
constexpr std::size_t kSignatureBytes = 32;
constexpr std::size_t kHeadBytes = 1 + 1 + 8 + kNonceBytes;  ///< Version, role, expiry, nonce.
constexpr std::size_t kMostText = 512;
constexpr std::size_t kTemporaryBytes = 9;  ///< Of the random part of a temporary file's name.

Result<std::string> randomBytes(std::size_t count) {
    std::string bytes(count, '\0');
    auto* data = reinterpret_cast<unsigned char*>(bytes.data());
    if (RAND_bytes(data, static_cast<int>(count)) != 1) {
        return fail(ErrorCode::kIo, "the system gives no random bytes");
    }
    return bytes;
}

/// Empty for what is not base64url.
std::string fromBase64Url(std::string text) {
    std::ranges::replace(text, '-', '+');
    std::ranges::replace(text, '_', '/');
    const std::size_t padding = (4 - text.size() % 4) % 4;
    if (text.empty() || padding == 3) return {};
    text.append(padding, '=');
    std::string bytes(text.size() / 4 * 3, '\0');
    const int length = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                       reinterpret_cast<const unsigned char*>(text.data()),
                                       static_cast<int>(text.size()));
    if (length < 0) return {};
    bytes.resize(static_cast<std::size_t>(length) - padding);
    return bytes;
}

std::string bytesOf(std::uint64_t number) {
    std::string bytes;
    for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
    return bytes;
}

std::uint64_t numberOf(const std::string& bytes) {
    std::uint64_t number = 0;
    for (const char byte : bytes) number = number << 8U | static_cast<unsigned char>(byte);
    return number;
}

/// What a signed text says; `rest` is up to its kind.
struct Signed {
    v1::Role role = v1::ROLE_UNSPECIFIED;
    std::chrono::system_clock::time_point expires{};
    std::string rest;
};

/// Texts of one purpose do not pass as those of another; messages name it by `what`.
struct Kind {
    const char* purpose;
    const char* what;
};
constexpr Kind kLink{"link", "link"};
constexpr Kind kAccess{"access", "access token"};

std::string signatureOf(const Kind& kind, const std::string& body, const LinkKey& key) {
    const auto signature = key.sign(kind.purpose, body);
    return {reinterpret_cast<const char*>(signature.data()), signature.size()};
}

Result<std::string> seal(const Kind& kind, const Signed& what, const LinkKey& key) {
    const auto nonce = randomBytes(kNonceBytes);
    if (!nonce) return nonce.error();
    const auto expires =
        std::chrono::duration_cast<std::chrono::seconds>(what.expires.time_since_epoch());
    const std::string body = std::string{kVersion, static_cast<char>(what.role)} +
                             bytesOf(static_cast<std::uint64_t>(expires.count())) + *nonce +
                             what.rest;
    return base64Url(body + signatureOf(kind, body, key));
}

Result<Signed> unseal(const Kind& kind, const std::string& text, const LinkKey& key,
                      std::chrono::system_clock::time_point now) {
    const std::string name = std::string{"the "} + kind.what;
    const Error forged = fail(ErrorCode::kInvalidArgument,
                              name + " was not made by this server, or was changed on its way");
    if (text.size() > kMostText) return forged;
    const std::string bytes = fromBase64Url(text);
    // One spelling of each: bits that no byte comes of could be changed otherwise.
    if (bytes.size() < kHeadBytes + kSignatureBytes || base64Url(bytes) != text) return forged;
    const std::string body = bytes.substr(0, bytes.size() - kSignatureBytes);
    const std::string expected = signatureOf(kind, body, key);
    if (CRYPTO_memcmp(expected.data(), bytes.data() + body.size(), kSignatureBytes) != 0) {
        return forged;
    }
    if (body[0] != kVersion || !v1::Role_IsValid(body[1])) return forged;
    const std::chrono::seconds expires{numberOf(body.substr(2, 8))};
    Signed read{.role = static_cast<v1::Role>(body[1]),
                .expires = std::chrono::system_clock::time_point{expires},
                .rest = body.substr(kHeadBytes)};
    if (now >= read.expires) return fail(ErrorCode::kInvalidArgument, name + " has expired");
    return read;
}

Error systemError(const std::string& path, const std::string& what) {
    return fail(ErrorCode::kIo, path + ": " + what + ": " + std::strerror(errno));
}

std::string hexadecimal(std::span<const std::byte> bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes) {
        text += kDigits[std::to_integer<unsigned>(byte) >> 4U];
        text += kDigits[std::to_integer<unsigned>(byte) & 15U];
    }
    return text;
}

/// A new file with `text`, on the disk, readable by its owner only; false, with errno, else.
bool writeWhole(const std::string& path, const std::string& text) {
    const base::FileDescriptor file{
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600)};
    if (!file.valid()) return false;
    const auto written = ::write(file.get(), text.data(), text.size());
    if (written < 0) return false;
    errno = ENOSPC;  // For a write that stopped short.
    return written == static_cast<ssize_t>(text.size()) && ::fsync(file.get()) == 0;
}

bool syncFolderOf(const std::string& path) {
    const std::string folder = std::filesystem::path{path}.parent_path().string();
    const base::FileDescriptor opened{
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    return opened.valid() && ::fsync(opened.get()) == 0;
}

}  // namespace

Result<LinkKey> LinkKey::random() {
    const auto bytes = randomBytes(kBytes);
    if (!bytes) return bytes.error();
    LinkKey key;
    std::ranges::transform(*bytes, key.bytes_.begin(),
                           [](char one) { return static_cast<std::byte>(one); });
    return key;
}

Result<LinkKey> LinkKey::fromFile(const std::string& path) {
    base::FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (!file.valid() && errno == ENOENT) {
        const auto made = random();
        if (!made) return made.error();
        const auto kept = made->keep(path);
        if (!kept) return kept.error();
        if (*kept) return *made;
        file = base::FileDescriptor{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    }
    if (!file.valid()) return systemError(path, "the key file cannot be opened");
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return systemError(path, "the key file");
    if ((status.st_mode & 077U) != 0) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ": others than its owner may use the key; chmod 600 it");
    }
    std::array<char, 2 * kBytes + 2> text{};
    const auto count = ::read(file.get(), text.data(), text.size());
    if (count < 0) return systemError(path, "the key cannot be read");
    std::string digits{text.data(), static_cast<std::size_t>(count)};
    if (digits.ends_with('\n')) digits.pop_back();
    const auto isDigit = [](unsigned char one) { return std::isxdigit(one) != 0; };
    if (digits.size() != 2 * kBytes || !std::ranges::all_of(digits, isDigit)) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ": not a key of " + std::to_string(2 * kBytes) + " hexadecimal digits");
    }
    LinkKey key;
    for (std::size_t i = 0; i < kBytes; ++i) {
        key.bytes_[i] = static_cast<std::byte>(std::stoul(digits.substr(2 * i, 2), nullptr, 16));
    }
    return key;
}

/// Written whole beside `path`, brought to the disk, then linked there: a crash leaves no key or
/// all of it, and of several that are made at once one stays. False where there is one already.
Result<bool> LinkKey::keep(const std::string& path) const {
    const auto unique = randomName(kTemporaryBytes);
    if (!unique) return unique.error();
    const std::string temporary = path + "." + *unique + ".tmp";
    if (!writeWhole(temporary, hexadecimal(bytes_) + "\n")) {
        const Error error = systemError(path, "the key cannot be written");
        ::unlink(temporary.c_str());
        return error;
    }
    const bool linked = ::link(temporary.c_str(), path.c_str()) == 0;
    const int why = errno;
    ::unlink(temporary.c_str());
    errno = why;
    if (!linked && errno == EEXIST) return false;
    if (!linked || !syncFolderOf(path)) return systemError(path, "the key file cannot be made");
    return true;
}

LinkKey::Signature LinkKey::sign(const std::string& purpose, const std::string& bytes) const {
    const std::string all = "volcast " + purpose + '\0' + bytes;
    Signature signature{};
    unsigned length = 0;
    HMAC(EVP_sha256(), bytes_.data(), static_cast<int>(bytes_.size()),
         reinterpret_cast<const unsigned char*>(all.data()), all.size(),
         reinterpret_cast<unsigned char*>(signature.data()), &length);
    return signature;
}

std::string base64Url(const std::string& bytes) {
    std::string text(bytes.size() / 3 * 4 + 5, '\0');  // EVP_EncodeBlock ends it with a 0.
    const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                       static_cast<int>(bytes.size()));
    text.resize(static_cast<std::size_t>(length));
    while (text.ends_with('=')) text.pop_back();
    std::ranges::replace(text, '+', '-');
    std::ranges::replace(text, '/', '_');
    return text;
}

Result<std::string> randomName(std::size_t bytes) {
    const auto random = randomBytes(bytes);
    if (!random) return random.error();
    return base64Url(*random);
}

Result<std::string> signLink(const Link& link, const LinkKey& key) {
    return seal(kLink, {.role = link.role, .expires = link.expires, .rest = link.view}, key);
}

Result<Link> readLink(const std::string& text, const LinkKey& key,
                      std::chrono::system_clock::time_point now) {
    auto read = unseal(kLink, text, key, now);
    if (!read) return read.error();
    return Link{.view = std::move(read->rest), .role = read->role, .expires = read->expires};
}

Result<std::string> signAccess(const Access& access, const LinkKey& key) {
    return seal(kAccess, {.role = access.role, .expires = access.expires, .rest = {}}, key);
}

Result<Access> readAccess(const std::string& text, const LinkKey& key,
                          std::chrono::system_clock::time_point now) {
    const auto read = unseal(kAccess, text, key, now);
    if (!read) return read.error();
    return Access{.role = read->role, .expires = read->expires};
}

}  // namespace volcast::session
