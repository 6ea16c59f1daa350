#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::session {

/// Something in the data folder that a loader takes.
struct FoundDataset {
    std::string id;    ///< Path relative to the folder, "." for the folder itself.
    std::string name;  ///< Last part of the path.
    /// Changes with the size, time or number of the files it consists of, companions
    /// (.raw of a .mhd) included.
    std::uint64_t signature = 0;
    friend bool operator==(const FoundDataset&, const FoundDataset&) = default;
};

inline constexpr int kMaxScanDepth = 6;
inline constexpr std::size_t kMaxScanEntries = 20'000;

/// Lists `folder`, sorted by id. A folder with several images of one kind is one dataset. Hidden
/// files, what lies deeper than kMaxScanDepth and links that lead out are left out; so is what
/// comes after kMaxScanEntries. `root` is the same folder, open.
std::vector<FoundDataset> scanFolder(const std::string& folder, const base::FileDescriptor& root);

}  // namespace volcast::session
