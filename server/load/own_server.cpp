#include "server/load/own_server.h"

#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <unistd.h>

namespace volcast::load {

namespace {

constexpr std::chrono::seconds kReadyWithin{60};
constexpr int kEndWithinMs = 10'000;
constexpr const char* kReadyMark = "Volcast is ready: ";

/// What stands behind the mark in the line that says so.
std::optional<std::string> urlIn(const std::string& output) {
    const auto mark = output.find(kReadyMark);
    const auto end = output.find('\n', mark);
    if (mark == std::string::npos || end == std::string::npos) return std::nullopt;
    const auto begin = mark + std::char_traits<char>::length(kReadyMark);
    return output.substr(begin, end - begin);
}

}  // namespace

Result<std::unique_ptr<OwnServer>> OwnServer::start(const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return fail(ErrorCode::kIo, "no pipe can be made");
    const base::FileDescriptor reading{ends[0]};
    base::FileDescriptor writing{ends[1]};
    workers::SpawnDesc desc{.program = workers::besideThisProgram("volcast"),
                            .arguments = {"serve", "--port", "0"},
                            .environment = workers::inheritedEnvironment({""}),
                            .output = writing.get()};
    desc.arguments.insert(desc.arguments.end(), arguments.begin(), arguments.end());
    auto child = workers::ChildProcess::spawn(desc);
    if (!child) return child.error();
    writing = {};
    std::string output;
    const auto until = std::chrono::steady_clock::now() + kReadyWithin;
    while (true) {
        if (auto url = urlIn(output)) {
            return std::unique_ptr<OwnServer>{new OwnServer{std::move(*child), std::move(*url)}};
        }
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
        pollfd entry{.fd = reading.get(), .events = POLLIN, .revents = 0};
        if (left.count() <= 0 || ::poll(&entry, 1, static_cast<int>(left.count())) == 0) {
            return fail(ErrorCode::kTimeout, "the server was not ready within 60 s");
        }
        std::array<char, 1024> buffer{};
        const ssize_t size = ::read(reading.get(), buffer.data(), buffer.size());
        if (size <= 0) {
            return fail(ErrorCode::kIo, "the server did not start: " + child->reap().text());
        }
        output.append(buffer.data(), static_cast<std::size_t>(size));
    }
}

OwnServer::~OwnServer() {
    ::kill(child_.pid(), SIGTERM);
    pollfd entry{.fd = child_.pidfd(), .events = POLLIN, .revents = 0};
    ::poll(&entry, 1, kEndWithinMs);
}

}  // namespace volcast::load
