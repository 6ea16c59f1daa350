#pragma once

#include <string>

namespace volcast::commands {

/// Where this user's driver may keep compiled shaders between runs; empty: nowhere.
std::string userCacheFolder();

}  // namespace volcast::commands
