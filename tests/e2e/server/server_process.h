#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace volcast::test {

/// How long a test waits for what must happen. Slow machines are no failure.
inline constexpr std::chrono::seconds kPatience{60};

/// Polls until `predicate` holds; false after kPatience.
bool eventually(const std::function<bool()>& predicate);

using support::TemporaryFolder;

void writeFile(const std::filesystem::path& path, const std::string& content);

/// A cube of 10 cells a side, 6 tetrahedra each, as TetGen's .node and .ele with one attribute,
/// f = x + 2 y + 3 z: `stem`.node and `stem`.ele.
void writeTetgenCube(const std::filesystem::path& stem);

/// What a process that ended said.
struct Ended {
    int exitCode = -1;  ///< 128 + signal where one ended it.
    std::string out, err;
};

/// A real `volcast` from the build, with its output in files; ended by the destructor.
class ServerProcess {
public:
    using Environment = std::vector<std::string>;  ///< "NAME=value", added to ours.

    /// `volcast serve --port 0 ARGUMENTS`, waiting until it is ready; check ready().
    explicit ServerProcess(const std::vector<std::string>& arguments = {},
                           const Environment& environment = {});
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;
    ServerProcess(ServerProcess&&) = delete;
    ServerProcess& operator=(ServerProcess&&) = delete;
    ~ServerProcess();

    [[nodiscard]] bool ready() const noexcept { return port_ != 0; }
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    [[nodiscard]] pid_t pid() const noexcept { return pid_; }
    void signal(int number) const;
    /// Waits for the end of the process; nullopt after kPatience.
    std::optional<Ended> wait();
    [[nodiscard]] std::string log() const;

private:
    TemporaryFolder folder_;
    pid_t pid_ = -1;
    std::uint16_t port_ = 0;
    std::optional<Ended> ended_;
};

/// Runs `volcast ARGUMENTS` to its end.
std::optional<Ended> runVolcast(const std::vector<std::string>& arguments,
                                const ServerProcess::Environment& environment = {});

}  // namespace volcast::test
