#include "server/session/encode_pool.h"

#include <algorithm>
#include <utility>

namespace volcast::session {

EncodePool::EncodePool(unsigned threads) {
    for (unsigned i = 0; i < std::max(1U, threads); ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

EncodePool::~EncodePool() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
        jobs_.clear();
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void EncodePool::run(std::function<void()> job) {
    {
        const std::lock_guard lock{mutex_};
        if (stopping_) return;
        jobs_.push_back(std::move(job));
    }
    wake_.notify_one();
}

std::size_t EncodePool::waiting() {
    const std::lock_guard lock{mutex_};
    return jobs_.size();
}

void EncodePool::work() {
    while (true) {
        std::function<void()> job;
        {
            std::unique_lock lock{mutex_};
            wake_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
            if (stopping_) return;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        job();
    }
}

}  // namespace volcast::session
