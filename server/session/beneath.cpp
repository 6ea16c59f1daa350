#include "server/session/beneath.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace volcast::session {
namespace {

constexpr int kMostLinks = 40;  ///< As many as the kernel follows in a path.
constexpr int kRead = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW;
constexpr int kPass = O_PATH | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW;

/// What says that there is nothing to read under a name: ENXIO is a socket, ENAMETOOLONG a name
/// that no file can have.
bool isAbsent(int error) {
    constexpr std::array kAbsent{ENOENT, ENOTDIR, EXDEV, ELOOP, ENAMETOOLONG, ENXIO};
    return std::ranges::find(kAbsent, error) != kAbsent.end();
}

/// Where a symbolic link leads; empty where `name` is none.
std::string targetOf(int folder, const std::string& name) {
    std::array<char, PATH_MAX> text{};
    const ssize_t length = ::readlinkat(folder, name.c_str(), text.data(), text.size());
    return {text.data(), length > 0 ? static_cast<std::size_t>(length) : 0};
}

/// A walk down from a folder, a name at a time. It holds every folder that it passed: ".." goes
/// back to the one it came from, wherever that may have been moved meanwhile.
class Walk {
public:
    Walk(int root, Links links) : root_{root}, links_{links} {}

    /// What `path` names, open for reading; not valid, with errno, where it cannot be had.
    base::FileDescriptor open(std::string path) {
        // The kernel would read the name up to the NUL alone.
        if (path.empty() || path.find('\0') != std::string::npos) return refuse(ENOENT);
        while (true) {
            if (path.starts_with('/')) return refuse(EXDEV);
            const std::size_t end = path.find('/');
            const bool last = end == std::string::npos;
            const std::string name = path.substr(0, end);
            path.erase(0, last ? end : path.find_first_not_of('/', end));
            if (name == "..") {
                if (passed_.empty()) return refuse(EXDEV);
                passed_.pop_back();
            } else if (!name.empty() && name != ".") {
                base::FileDescriptor next{::openat(here(), name.c_str(), last ? kRead : kPass)};
                if (!next.valid()) {
                    if (!follow(name, path, last)) return {};
                    continue;
                }
                if (last) return next;
                passed_.push_back(std::move(next));
            }
            if (last) return base::FileDescriptor{::openat(here(), ".", kRead | O_DIRECTORY)};
        }
    }

private:
    int here() const { return passed_.empty() ? root_ : passed_.back().get(); }

    static base::FileDescriptor refuse(int error) {
        errno = error;
        return {};
    }

    /// After `name` could not be opened: puts in front of `rest` where it leads, if it is a link.
    bool follow(const std::string& name, std::string& rest, bool last) {
        const int error = errno;
        const bool mayBeLink = error == ELOOP || error == ENOTDIR;
        std::string target = mayBeLink ? targetOf(here(), name) : std::string{};
        const bool refused = links_ == Links::kRefuse || followed_ == kMostLinks;
        errno = target.empty() || !refused ? error : ELOOP;
        if (target.empty() || refused) return false;
        ++followed_;
        rest = last ? std::move(target) : std::move(target) + "/" + rest;
        return true;
    }

    int root_;
    Links links_;
    int followed_ = 0;
    std::vector<base::FileDescriptor> passed_;
};

}  // namespace

Result<base::FileDescriptor> openFolder(const std::string& path) {
    // For reading, so that a folder that may not be listed is refused here and not later.
    base::FileDescriptor folder{::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (folder.valid()) return folder;
    const std::string text = path + ": " + std::strerror(errno);
    if (errno == ENOENT) return fail(ErrorCode::kNotFound, text);
    if (errno == ENOTDIR) return fail(ErrorCode::kInvalidArgument, text);
    return fail(ErrorCode::kIo, text);
}

// Not by openat2(RESOLVE_BENEATH): a service manager that forbids set-user-ID files refuses that
// call whole, because a filter cannot look at flags behind a pointer (systemd.exec(5),
// RestrictSUIDSGID=, which DynamicUser= implies).
Result<base::FileDescriptor> openBeneath(const base::FileDescriptor& folder,
                                         const std::string& path, Links links) {
    base::FileDescriptor file = Walk{folder.get(), links}.open(path);
    if (file.valid()) return file;
    const int why = errno;
    return fail(isAbsent(why) ? ErrorCode::kNotFound : ErrorCode::kIo,
                path + ": " + std::strerror(why));
}

}  // namespace volcast::session
