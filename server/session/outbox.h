#pragma once

#include <deque>
#include <functional>
#include <mutex>

namespace volcast::session {

/// Calls to others, gathered while a lock is held and made in order after it was given back, by
/// one thread at a time: whoever is called may call back, or take as long as it likes.
class Outbox {
public:
    /// The caller's lock guards the outbox, here as in flush().
    void put(std::function<void()> call) { calls_.push_back(std::move(call)); }

    /// Makes the calls without the lock. Returns at once where another thread is doing so: it takes
    /// along what was put since.
    void flush(std::unique_lock<std::mutex>& lock) {
        if (flushing_) return;
        flushing_ = true;
        while (!calls_.empty()) {
            const auto call = std::move(calls_.front());
            calls_.pop_front();
            lock.unlock();
            call();
            lock.lock();
        }
        flushing_ = false;
    }

private:
    std::deque<std::function<void()>> calls_;
    bool flushing_ = false;
};

}  // namespace volcast::session
