#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "server/workers/child_process.h"

namespace volcast::load {

/// A `volcast serve` of this build on a free loopback port, for the length of a run.
class OwnServer {
public:
    /// Starts it and waits until it is ready; `arguments` go behind `serve --port 0`.
    ///
    /// Errors: kNotFound, kIo (it ended; its words are on stderr), kTimeout (60 s).
    static Result<std::unique_ptr<OwnServer>> start(const std::vector<std::string>& arguments);
    OwnServer(const OwnServer&) = delete;
    OwnServer& operator=(const OwnServer&) = delete;
    OwnServer(OwnServer&&) = delete;
    OwnServer& operator=(OwnServer&&) = delete;
    /// Asks it to end, and kills it where it does not within 10 s.
    ~OwnServer();

    [[nodiscard]] const std::string& url() const noexcept { return url_; }
    [[nodiscard]] int pid() const noexcept { return child_.pid(); }

private:
    OwnServer(workers::ChildProcess child, std::string url)
        : child_{std::move(child)}, url_{std::move(url)} {}

    workers::ChildProcess child_;
    std::string url_;
};

}  // namespace volcast::load
