#include "server/workers/private_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace volcast::workers {

Result<PrivateFolder> PrivateFolder::create() {
    const char* parent = std::getenv("TMPDIR");
    std::string path =
        std::string{parent != nullptr && *parent != '\0' ? parent : "/tmp"} + "/volcast-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr) {
        return fail(ErrorCode::kIo, path + ": cannot be made: " + std::strerror(errno));
    }
    PrivateFolder folder;
    folder.path_ = path;
    return folder;
}

PrivateFolder::~PrivateFolder() {
    if (path_.empty()) return;
    std::error_code ignored;  // What cannot be removed is left to the system's own cleaning.
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace volcast::workers
