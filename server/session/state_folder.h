#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "server/session/saved_view.h"

namespace volcast::session {

/// A folder that keeps views over restarts of the server: a file for each, written whole beside the
/// old one, brought to the disk, then renamed over it. What it did not write it never changes.
class StateFolder {
public:
    /// The view of that id as it is to be saved; empty where there is none any more.
    using Source = std::function<std::optional<SavedView>(const std::string& id)>;

    static constexpr const char* kKeyFile = "link.key";  ///< Where no other key is named.
    static constexpr std::chrono::milliseconds kRetry{5000};

    /// Makes the folder where there is none. Errors: kIo.
    static Result<std::unique_ptr<StateFolder>> create(const std::string& path);
    StateFolder(const StateFolder&) = delete;
    StateFolder& operator=(const StateFolder&) = delete;
    StateFolder(StateFolder&&) = delete;
    StateFolder& operator=(StateFolder&&) = delete;
    ~StateFolder() { finish(); }

    /// All that was saved. Files that are damaged, or no views, are named in the log and left
    /// alone.
    [[nodiscard]] std::vector<SavedView> load() const;
    /// Writes from now on what changed(), on a thread of its own; what could not be written, as on
    /// a disk that is full, is tried again after `retry`, and once more by finish().
    void begin(Source source, std::chrono::milliseconds retry = kRetry);
    /// The view is to be written soon; of several changes the newest. Any thread; soon back.
    void changed(const std::string& id);
    /// Writes what is still to be written, and nothing from then on.
    void finish();

private:
    StateFolder(std::string path, base::FileDescriptor folder);
    void work();
    void writeAll(const std::set<std::string>& ids);
    /// False, with errno, where the disk does not hold the view as it is.
    [[nodiscard]] bool write(const std::string& id) const;
    [[nodiscard]] bool replace(const std::string& name, const std::string& text) const;

    const std::string path_;
    const base::FileDescriptor folder_;
    Source source_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::set<std::string> changed_;
    std::set<std::string> failed_;  ///< Not on the disk yet; of `thread_` alone.
    std::chrono::milliseconds retry_ = kRetry;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace volcast::session
