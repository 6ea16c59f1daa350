#include "renderer/base/landlock.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::base {

namespace {

// The kernel's interface, spelled out because Debian 12's header ends at version 2.
// Source: the kernel's Documentation/userspace-api/landlock.rst.
constexpr std::uint64_t kExecute = 1U << 0;
constexpr std::uint64_t kWriteFile = 1U << 1;
constexpr std::uint64_t kReadFile = 1U << 2;
constexpr std::uint64_t kReadDir = 1U << 3;
constexpr std::uint64_t kTruncate = 1U << 14;
constexpr std::uint64_t kIoctlDev = 1U << 15;
constexpr std::uint64_t kTcpBindAndConnect = 3;
constexpr std::uint64_t kScopeAbstractSocketsAndSignals = 3;
constexpr unsigned kGetVersion = 1;
constexpr int kRulePathBeneath = 1;
/// What a rule on a plain file may hold; the kernel refuses folder rights there.
constexpr std::uint64_t kFileRights = kExecute | kWriteFile | kReadFile | kTruncate | kIoctlDev;

struct RulesetAttributes {
    std::uint64_t handledFiles = 0;
    std::uint64_t handledNetwork = 0;
    std::uint64_t scoped = 0;
};

struct [[gnu::packed]] PathBeneath {
    std::uint64_t allowed = 0;
    std::int32_t parent = -1;
};

/// All file rights that version `abi` knows.
std::uint64_t fileRights(int abi) {
    constexpr std::array<unsigned, 6> kRightsByAbi{0, 13, 14, 15, 15, 16};
    const auto known = static_cast<std::size_t>(std::min(abi, 5));
    return (std::uint64_t{1} << kRightsByAbi.at(known)) - 1;
}

/// Older kernels take only the first members.
std::size_t attributesSize(int abi) {
    if (abi >= 6) return sizeof(RulesetAttributes);
    return abi >= 4 ? offsetof(RulesetAttributes, scoped)
                    : offsetof(RulesetAttributes, handledNetwork);
}

Error stepFailed(const std::string& step) {
    return fail(ErrorCode::kIo, "landlock: " + step + ": " + std::strerror(errno));
}

Result<void> allow(const FileDescriptor& ruleset, const std::string& path, std::uint64_t rights) {
    const FileDescriptor place{::open(path.c_str(), O_PATH | O_CLOEXEC)};
    if (!place.valid()) {
        if (errno == ENOENT) return {};
        return stepFailed("cannot open " + path);
    }
    struct stat info {};
    if (::fstat(place.get(), &info) != 0) return stepFailed("cannot look at " + path);
    if (!S_ISDIR(info.st_mode)) rights &= kFileRights;
    const PathBeneath rule{.allowed = rights, .parent = place.get()};
    if (::syscall(SYS_landlock_add_rule, ruleset.get(), kRulePathBeneath, &rule, 0U) != 0) {
        return stepFailed("cannot allow " + path);
    }
    return {};
}

}  // namespace

int landlockAbi() noexcept {
    const long abi = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kGetVersion);
    return abi > 0 ? static_cast<int>(abi) : 0;
}

Result<void> applyLandlock(const LandlockRules& rules) {
    const int abi = landlockAbi();
    if (abi == 0) return {};
    const std::uint64_t handled = fileRights(abi);
    const RulesetAttributes attributes{.handledFiles = handled,
                                       .handledNetwork = kTcpBindAndConnect,
                                       .scoped = kScopeAbstractSocketsAndSignals};
    const FileDescriptor ruleset{static_cast<int>(
        ::syscall(SYS_landlock_create_ruleset, &attributes, attributesSize(abi), 0U))};
    if (!ruleset.valid()) return stepFailed("cannot create a ruleset");
    const std::uint64_t execute = rules.mayExecute ? kExecute : 0;
    for (const std::string& path : rules.readable) {
        auto allowed = allow(ruleset, path, kReadFile | kReadDir | execute);
        if (!allowed) return allowed;
    }
    for (const std::string& path : rules.writable) {
        auto allowed = allow(ruleset, path, handled & ~kExecute);
        if (!allowed) return allowed;
    }
    if (::syscall(SYS_landlock_restrict_self, ruleset.get(), 0U) != 0) {
        return stepFailed("cannot restrict this process");
    }
    return {};
}

}  // namespace volcast::base
