#pragma once

#include <string>

namespace volcast::workers {

/// A note in the cache folder that a server gave up its GPU, for `doctor`, which is another
/// process.
void noteGpuGivenUp(const std::string& cacheFolder, const std::string& why);
/// When and why; empty: there is no note.
std::string gpuGivenUp(const std::string& cacheFolder);
void forgetGpuGivenUp(const std::string& cacheFolder);

}  // namespace volcast::workers
