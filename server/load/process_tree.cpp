#include "server/load/process_tree.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <unistd.h>

namespace volcast::load {

namespace {

namespace fs = std::filesystem;

struct Stat {
    int parent = 0;
    unsigned threads = 0;
    double cpuS = 0;        ///< Its own.
    double reapedCpuS = 0;  ///< Of children that ended and were waited for.
    std::uint64_t bytes = 0;
};

/// proc(5), /proc/[pid]/stat. The name may hold blanks, so fields count from its last bracket.
std::optional<Stat> statOf(const fs::path& folder) {
    std::ifstream file{folder / "stat"};
    std::string text;
    if (!std::getline(file, text)) return std::nullopt;
    const auto bracket = text.rfind(')');
    if (bracket == std::string::npos) return std::nullopt;
    std::istringstream fields{text.substr(bracket + 1)};
    std::string state, skipped;
    Stat stat;
    double user = 0, system = 0, reapedUser = 0, reapedSystem = 0;
    std::uint64_t pages = 0;
    fields >> state >> stat.parent;
    for (int i = 5; i <= 13; ++i) fields >> skipped;
    fields >> user >> system >> reapedUser >> reapedSystem >> skipped >> skipped >> stat.threads;
    for (int i = 21; i <= 23; ++i) fields >> skipped;
    if (!(fields >> pages)) return std::nullopt;
    const auto ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
    stat.cpuS = (user + system) / ticks;
    stat.reapedCpuS = (reapedUser + reapedSystem) / ticks;
    stat.bytes = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return stat;
}

std::map<int, Stat> allProcesses() {
    std::map<int, Stat> all;
    std::error_code ignored;
    for (fs::directory_iterator at{"/proc", ignored}, end; at != end; at.increment(ignored)) {
        const std::string name = at->path().filename();
        int pid = 0;
        if (std::from_chars(name.data(), name.data() + name.size(), pid).ec != std::errc{})
            continue;
        if (const auto stat = statOf(at->path())) all[pid] = *stat;
    }
    return all;
}

unsigned descriptorsOf(int pid) {
    unsigned count = 0;
    std::error_code ignored;
    for (fs::directory_iterator at{"/proc/" + std::to_string(pid) + "/fd", ignored}, end; at != end;
         at.increment(ignored)) {
        ++count;
    }
    return count;
}

bool descendsFrom(int root, int pid, const std::map<int, Stat>& all) {
    for (auto at = all.find(pid); at != all.end(); at = all.find(at->second.parent)) {
        if (at->second.parent == root) return true;
        if (at->second.parent == 0) break;
    }
    return false;
}

}  // namespace

std::optional<TreeUse> treeUse(int pid) {
    const auto all = allProcesses();
    const auto root = all.find(pid);
    if (root == all.end()) return std::nullopt;
    TreeUse use{.rootCpuS = root->second.cpuS,
                .childrenCpuS = root->second.reapedCpuS,
                .rootBytes = root->second.bytes,
                .treeBytes = root->second.bytes,
                .processes = 1,
                .rootThreads = root->second.threads,
                .rootDescriptors = descriptorsOf(pid),
                .treeThreads = root->second.threads};
    use.treeDescriptors = use.rootDescriptors;
    for (const auto& [other, stat] : all) {
        if (!descendsFrom(pid, other, all)) continue;
        use.childrenCpuS += stat.cpuS + stat.reapedCpuS;
        use.treeBytes += stat.bytes;
        use.treeThreads += stat.threads;
        use.treeDescriptors += descriptorsOf(other);
        ++use.processes;
    }
    return use;
}

}  // namespace volcast::load
