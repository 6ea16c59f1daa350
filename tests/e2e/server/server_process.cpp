#include "tests/e2e/server/server_process.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace volcast::test {

namespace {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
    std::ifstream file{path, std::ios::binary};
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Starts `volcast` with its output in `folder`; -1 where it cannot be started.
pid_t start(const fs::path& folder, const std::vector<std::string>& arguments,
            const ServerProcess::Environment& environment) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "volcast";
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv, envp;
    for (std::string& word : words) argv.push_back(word.data());
    std::vector<std::string> ours = environment;
    for (std::string& one : ours) envp.push_back(one.data());
    for (char** one = environ; *one != nullptr; ++one) envp.push_back(*one);
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto write = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, 1, (folder / "out").c_str(), write, 0600);
    posix_spawn_file_actions_addopen(&files, 2, (folder / "err").c_str(), write, 0600);
    pid_t pid = -1;
    const int failed =
        posix_spawn(&pid, program.c_str(), &files, nullptr, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&files);
    return failed != 0 ? -1 : pid;
}

/// In a build with sanitizers: the server and its children, which it replaces when they die, share
/// one stderr, and none may have been reported.
void expectNoSanitizerReport(const std::string& err) {
    for (const char* mark : {"Sanitizer", "runtime error: "}) {
        EXPECT_EQ(err.find(mark), std::string::npos) << err;
    }
}

std::optional<Ended> waitFor(pid_t pid, const fs::path& folder) {
    int status = 0;
    if (!eventually([&] { return ::waitpid(pid, &status, WNOHANG) == pid; })) return std::nullopt;
    Ended ended{.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                .out = readFile(folder / "out"),
                .err = readFile(folder / "err")};
    expectNoSanitizerReport(ended.err);
    return ended;
}

}  // namespace

bool eventually(const std::function<bool()>& predicate) {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < until) {
        if (predicate()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    return predicate();
}

void writeFile(const fs::path& path, const std::string& content) {
    fs::create_directories(path.parent_path());
    std::ofstream{path, std::ios::binary} << content;
}

void writeTetgenCube(const fs::path& stem) {
    constexpr int kSide = 10, kPoints = kSide + 1;
    std::ostringstream nodes, cells;
    const auto index = [](int x, int y, int z) { return (z * kPoints + y) * kPoints + x; };
    nodes << kPoints * kPoints * kPoints << " 3 1 0\n";
    for (int z = 0; z < kPoints; ++z) {
        for (int y = 0; y < kPoints; ++y) {
            for (int x = 0; x < kPoints; ++x) {
                nodes << index(x, y, z) << ' ' << 0.1 * x << ' ' << 0.1 * y << ' ' << 0.1 * z << ' '
                      << 0.1 * (x + 2 * y + 3 * z) << '\n';
            }
        }
    }
    // Kuhn's six tetrahedra: along the paths from the lowest to the highest corner.
    constexpr std::array<std::array<int, 3>, 6> kOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    cells << 6 * kSide * kSide * kSide << " 4 0\n";
    int cell = 0;
    for (int at = 0; at < kSide * kSide * kSide; ++at) {
        for (const auto& order : kOrders) {
            std::array<int, 3> corner{at % kSide, at / kSide % kSide, at / kSide / kSide};
            cells << cell++ << ' ' << index(corner[0], corner[1], corner[2]);
            for (const int axis : order) {
                ++corner[static_cast<std::size_t>(axis)];
                cells << ' ' << index(corner[0], corner[1], corner[2]);
            }
            cells << '\n';
        }
    }
    writeFile(stem.string() + ".node", nodes.str());
    writeFile(stem.string() + ".ele", cells.str());
}

ServerProcess::ServerProcess(const std::vector<std::string>& arguments,
                             const Environment& environment) {
    std::vector<std::string> all{"serve", "--port", "0"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    pid_ = start(folder_.path(), all, environment);
    if (pid_ < 0) return;
    eventually([this] {
        const std::string out = readFile(folder_.path() / "out");
        const auto line = out.find("Volcast is ready: http");
        const auto end = out.find("/\n");
        if (line != std::string::npos && end != std::string::npos) {
            port_ = static_cast<std::uint16_t>(std::stoi(out.substr(out.rfind(':') + 1)));
            return true;
        }
        siginfo_t info{};
        ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid == pid_;
    });
}

ServerProcess::~ServerProcess() {
    if (pid_ < 0 || ended_) return;
    signal(SIGTERM);
    if (!waitFor(pid_, folder_.path())) signal(SIGKILL);
}

void ServerProcess::signal(int number) const {
    if (pid_ > 0 && !ended_) ::kill(pid_, number);
}

std::optional<Ended> ServerProcess::wait() {
    if (!ended_ && pid_ > 0) ended_ = waitFor(pid_, folder_.path());
    return ended_;
}

std::string ServerProcess::log() const {
    return readFile(folder_.path() / "err");
}

std::optional<Ended> runVolcast(const std::vector<std::string>& arguments,
                                const ServerProcess::Environment& environment) {
    const TemporaryFolder folder;
    const pid_t pid = start(folder.path(), arguments, environment);
    if (pid < 0) return std::nullopt;
    auto ended = waitFor(pid, folder.path());
    if (!ended) ::kill(pid, SIGKILL);
    return ended;
}

}  // namespace volcast::test
