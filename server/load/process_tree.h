#pragma once

#include <cstdint>
#include <optional>

namespace volcast::load {

/// What a process and its descendants have used.
struct TreeUse {
    double rootCpuS = 0;          ///< The process itself, user and system.
    double childrenCpuS = 0;      ///< Its descendants, those that ended included.
    std::uint64_t rootBytes = 0;  ///< Resident.
    std::uint64_t treeBytes = 0;  ///< Resident, all together; shared pages count in each.
    unsigned processes = 0;
    unsigned rootThreads = 0;
    unsigned rootDescriptors = 0;
    unsigned treeThreads = 0;      ///< With descendants.
    unsigned treeDescriptors = 0;  ///< With those descendants whose /proc may be read.

    [[nodiscard]] double cpuS() const noexcept { return rootCpuS + childrenCpuS; }
};

/// Reads /proc; empty where there is no process `pid`.
std::optional<TreeUse> treeUse(int pid);

}  // namespace volcast::load
