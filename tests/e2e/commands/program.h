#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "server/workers/child_process.h"
#include "tests/support/temporary_folder.h"

namespace volcast::test {

/// A folder of one test's own.
class Folder : public support::TemporaryFolder {
public:
    [[nodiscard]] std::string file(const std::string& name) const { return path() / name; }
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
        std::ofstream{path() / name} << text;
        return file(name);
    }
};

inline std::string contentOf(const std::string& path) {
    std::ifstream stream{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

/// Polls until `predicate` holds; false after a minute.
inline bool eventually(const std::function<bool()>& predicate) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes{1};
    while (!predicate()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return true;
}

struct Outcome {
    int exitCode = -1;
    std::string out, err;
};

/// Runs the real `volcast` to its end.
inline Outcome runVolcast(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {}) {
    const Folder folder;
    workers::SpawnDesc desc;
    desc.program = "/bin/sh";
    // The words travel as arguments, so that no shell looks at them.
    desc.arguments = {"-c",
                      R"(out=$1; err=$2; shift 2; exec "$@" >"$out" 2>"$err")",
                      "sh",
                      folder.file("out"),
                      folder.file("err"),
                      workers::besideThisProgram("volcast")};
    desc.arguments.insert(desc.arguments.end(), arguments.begin(), arguments.end());
    desc.environment = environment;
    desc.environment.push_back("TMPDIR=" + std::filesystem::temp_directory_path().string());
    for (std::string& variable :
         workers::inheritedEnvironment({"ASAN_", "TSAN_", "UBSAN_", "HOME="})) {
        desc.environment.push_back(std::move(variable));
    }
    auto child = workers::ChildProcess::spawn(desc);
    EXPECT_TRUE(child.has_value());
    const workers::ExitStatus status = child->reap();
    EXPECT_FALSE(status.signalled) << status.text();
    return {.exitCode = status.value,
            .out = contentOf(folder.file("out")),
            .err = contentOf(folder.file("err"))};
}

}  // namespace volcast::test
