#include "server/session/beneath.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace volcast::session {

Result<base::FileDescriptor> openFolder(const std::string& path) {
    // For reading, so that a folder that may not be listed is refused here and not later.
    base::FileDescriptor folder{::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (folder.valid()) return folder;
    const std::string text = path + ": " + std::strerror(errno);
    if (errno == ENOENT) return fail(ErrorCode::kNotFound, text);
    if (errno == ENOTDIR) return fail(ErrorCode::kInvalidArgument, text);
    return fail(ErrorCode::kIo, text);
}

Result<base::FileDescriptor> openBeneath(const base::FileDescriptor& folder,
                                         const std::string& path, Links links) {
    open_how how{};
    how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    if (links == Links::kRefuse) how.resolve |= RESOLVE_NO_SYMLINKS;
    base::FileDescriptor file{
        static_cast<int>(::syscall(SYS_openat2, folder.get(), path.c_str(), &how, sizeof(how)))};
    if (file.valid()) return file;
    const std::string text = path + ": " + std::strerror(errno);
    const bool absent = errno == ENOENT || errno == ENOTDIR || errno == EXDEV || errno == ELOOP;
    return fail(absent ? ErrorCode::kNotFound : ErrorCode::kIo, text);
}

}  // namespace volcast::session
