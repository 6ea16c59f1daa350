#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace volcast::session {

/// A few threads that compress pictures, so that no encode delays a socket.
///
/// The queue is bounded by its users: each view has at most one job in it.
class EncodePool {
public:
    explicit EncodePool(unsigned threads);
    EncodePool(const EncodePool&) = delete;
    EncodePool& operator=(const EncodePool&) = delete;
    EncodePool(EncodePool&&) = delete;
    EncodePool& operator=(EncodePool&&) = delete;
    /// Finishes the job in each thread, drops those that wait.
    ~EncodePool();

    /// Runs `job` on one of the threads; jobs must not throw. Any thread.
    void run(std::function<void()> job);
    /// Jobs that no thread has begun.
    [[nodiscard]] std::size_t waiting();

private:
    void work();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> jobs_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace volcast::session
