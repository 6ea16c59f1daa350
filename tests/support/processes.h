#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace volcast::test {

/// How long a test waits for something that must happen. Slow machines are no failure.
inline constexpr std::chrono::seconds kPatience{60};

/// Polls until `predicate` holds; false after kPatience.
inline bool eventually(const std::function<bool()>& predicate) {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!predicate()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return true;
}

/// The file `name` of a process in /proc; empty: there is no such process any more.
inline std::string procText(int pid, const std::string& name) {
    std::ifstream file{"/proc/" + std::to_string(pid) + "/" + name};
    return {std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
}

/// State and parent from /proc/PID/stat; the name between them may hold anything.
struct ProcessStat {
    std::string state;
    int parent = 0;
};

inline std::optional<ProcessStat> statOf(int pid) {
    const std::string text = procText(pid, "stat");
    const std::size_t end = text.rfind(')');
    if (end == std::string::npos || end + 4 > text.size()) return std::nullopt;
    return ProcessStat{.state = text.substr(end + 2, 1), .parent = std::stoi(text.substr(end + 4))};
}

/// Processes whose parent is `pid`; a zombie counts.
inline std::vector<int> childrenOf(int pid) {
    std::vector<int> children;
    for (const auto& entry : std::filesystem::directory_iterator{"/proc"}) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const auto stat = statOf(std::stoi(name));
        if (stat && stat->parent == pid) children.push_back(std::stoi(name));
    }
    return children;
}

/// State letter of a process ("R", "S", "T", "Z"); empty: there is none.
inline std::string stateOf(int pid) {
    const auto stat = statOf(pid);
    return stat ? stat->state : std::string{};
}

}  // namespace volcast::test
