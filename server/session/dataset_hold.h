#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace volcast::session {

/// Counts who shows a dataset. Any thread.
class DatasetHolds {
public:
    void add(const std::vector<std::string>& ids) {
        const std::lock_guard lock{mutex_};
        for (const std::string& id : ids) ++counts_[id];
    }
    void drop(const std::vector<std::string>& ids) {
        const std::lock_guard lock{mutex_};
        for (const std::string& id : ids) {
            const auto found = counts_.find(id);
            if (--found->second == 0) counts_.erase(found);
        }
    }
    [[nodiscard]] bool holds(const std::string& id) const {
        const std::lock_guard lock{mutex_};
        return counts_.contains(id);
    }

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::size_t> counts_;
};

/// While it lives, its datasets stay loaded where they are or will be. It may outlive the
/// catalogue.
class DatasetHold {
public:
    DatasetHold() = default;
    DatasetHold(std::shared_ptr<DatasetHolds> all, std::vector<std::string> ids)
        : all_{std::move(all)}, ids_{std::move(ids)} {
        all_->add(ids_);
    }
    DatasetHold(const DatasetHold&) = delete;
    DatasetHold& operator=(const DatasetHold&) = delete;
    DatasetHold(DatasetHold&& other) noexcept
        : all_{std::exchange(other.all_, nullptr)}, ids_{std::exchange(other.ids_, {})} {}
    DatasetHold& operator=(DatasetHold&& other) noexcept {
        DatasetHold taken{std::move(other)};
        std::swap(all_, taken.all_);
        std::swap(ids_, taken.ids_);
        return *this;
    }
    ~DatasetHold() {
        if (all_) all_->drop(ids_);
    }

private:
    std::shared_ptr<DatasetHolds> all_;
    std::vector<std::string> ids_;
};

}  // namespace volcast::session
