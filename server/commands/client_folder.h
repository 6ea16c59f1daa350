#pragma once

#include <filesystem>
#include <string>

namespace volcast::commands {

/// Where the built web client of `program` is: web_client beside its folder, where
/// `cmake --install` puts it; else beside the build's folder, whether it is there or not.
std::string clientFolderOf(const std::filesystem::path& program);

}  // namespace volcast::commands
