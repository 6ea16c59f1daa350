#include "server/commands/client_folder.h"

#include <system_error>

namespace volcast::commands {

std::string clientFolderOf(const std::filesystem::path& program) {
    constexpr const char* kName = "web_client";
    const std::filesystem::path bin = program.parent_path();
    const std::filesystem::path installed = bin.parent_path() / kName;
    std::error_code ignored;
    if (std::filesystem::exists(installed / "index.html", ignored)) return installed.string();
    return (bin.parent_path().parent_path() / kName).string();
}

}  // namespace volcast::commands
