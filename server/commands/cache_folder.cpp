#include "server/commands/cache_folder.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace volcast::commands {

std::string userCacheFolder() {
    namespace fs = std::filesystem;
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    fs::path folder;
    if (cache != nullptr && *cache == '/') {
        folder = cache;
    } else if (home != nullptr && *home == '/') {
        folder = fs::path{home} / ".cache";
    } else {
        return {};
    }
    folder /= "volcast/shaders";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) return {};
    fs::permissions(folder, fs::perms::owner_all, error);
    return folder.string();
}

}  // namespace volcast::commands
