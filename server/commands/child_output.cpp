#include "server/commands/child_output.h"

#include <array>
#include <chrono>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include "server/workers/child_process.h"

namespace volcast::commands {

namespace {

constexpr std::chrono::seconds kPatience{30};
constexpr std::size_t kMaxText = std::size_t{1} << 20;

}  // namespace

Result<ChildOutput> outputOf(const std::string& program,
                             const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return fail(ErrorCode::kIo, "no pipe can be made");
    const base::FileDescriptor reading{ends[0]};
    base::FileDescriptor writing{ends[1]};
    workers::SpawnDesc desc;
    desc.program = program;
    desc.arguments = arguments;
    desc.environment = workers::inheritedEnvironment({""});
    desc.output = writing.get();
    auto child = workers::ChildProcess::spawn(desc);
    if (!child) return std::move(child).error();
    writing = {};

    ChildOutput output;
    const auto until = std::chrono::steady_clock::now() + kPatience;
    for (;;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
        pollfd entry{.fd = reading.get(), .events = POLLIN, .revents = 0};
        if (left.count() <= 0 || ::poll(&entry, 1, static_cast<int>(left.count())) == 0) {
            return fail(ErrorCode::kTimeout, program + ": took longer than 30 s");
        }
        std::array<char, 4096> buffer{};
        const ssize_t size = ::read(reading.get(), buffer.data(), buffer.size());
        if (size <= 0 || output.text.size() > kMaxText) break;
        output.text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    const workers::ExitStatus status = child->reap();
    output.succeeded = !status.signalled && status.value == 0;
    output.ending = status.text();
    return output;
}

}  // namespace volcast::commands
