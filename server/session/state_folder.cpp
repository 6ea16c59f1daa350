#include "server/session/state_folder.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"

namespace volcast::session {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".view.json";
constexpr const char* kTemporary = ".view.tmp";
constexpr std::uintmax_t kMostBytes = std::uintmax_t{16} << 20U;
/// Changes of a drag are gathered so long.
constexpr std::chrono::milliseconds kGather{100};

Result<SavedView> read(const fs::path& path) {
    std::error_code error;
    const auto status = fs::symlink_status(path, error);
    if (error || !fs::is_regular_file(status)) {
        return fail(ErrorCode::kInvalidArgument, "not a regular file");
    }
    if (const auto size = fs::file_size(path, error); error || size > kMostBytes) {
        return fail(ErrorCode::kLimitExceeded,
                    "larger than " + std::to_string(kMostBytes) + " bytes");
    }
    std::ifstream file{path, std::ios::binary};
    std::stringstream text;
    text << file.rdbuf();
    auto view = savedViewFromJson(text.str());
    if (view && path.filename() != view->id + kSuffix) {
        return fail(ErrorCode::kInvalidArgument, "its name is not that of the view in it");
    }
    return view;
}

}  // namespace

Result<std::unique_ptr<StateFolder>> StateFolder::create(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    base::FileDescriptor folder{::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (error || !folder.valid()) {
        return fail(ErrorCode::kIo, "--state-dir " + path + ": " +
                                        (error ? error.message() : std::strerror(errno)));
    }
    if (::faccessat(folder.get(), ".", W_OK | X_OK, 0) != 0) {
        return fail(ErrorCode::kIo, "--state-dir " + path + ": " + std::strerror(errno));
    }
    return std::unique_ptr<StateFolder>{new StateFolder{path, std::move(folder)}};
}

StateFolder::StateFolder(std::string path, base::FileDescriptor folder)
    : path_{std::move(path)}, folder_{std::move(folder)} {}

void StateFolder::finish() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

std::vector<SavedView> StateFolder::load() const {
    std::vector<SavedView> views;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator{path_, error}) {
        const std::string name = entry.path().filename().string();
        // A write that a crash cut off; the key, or one that a crash cut off.
        if (name.ends_with(kTemporary) || name.starts_with(kKeyFile)) continue;
        auto view = name.ends_with(kSuffix)
                        ? read(entry.path())
                        : Result<SavedView>{fail(ErrorCode::kInvalidArgument, "not a saved view")};
        if (view) {
            views.push_back(*std::move(view));
        } else {
            spdlog::warn(R"(event=state_file_skipped file="{}" error="{}")",
                         base::printable(entry.path().string(), 1000),
                         base::printable(view.error().message, 1000));
        }
    }
    return views;
}

void StateFolder::begin(Source source, std::chrono::milliseconds retry) {
    source_ = std::move(source);
    retry_ = retry;
    thread_ = std::thread{[this] { work(); }};
}

void StateFolder::changed(const std::string& id) {
    {
        const std::lock_guard lock{mutex_};
        changed_.insert(id);
    }
    wake_.notify_one();
}

void StateFolder::work() {
    std::unique_lock lock{mutex_};
    const auto due = [this] { return stopping_ || !changed_.empty(); };
    while (true) {
        if (failed_.empty()) {
            wake_.wait(lock, due);
        } else {
            wake_.wait_for(lock, retry_, due);
        }
        if (!stopping_) wake_.wait_for(lock, kGather, [this] { return stopping_; });
        const bool last = stopping_;
        auto ids = std::exchange(changed_, {});
        lock.unlock();
        ids.insert(failed_.begin(), failed_.end());
        writeAll(ids);
        lock.lock();
        if (last && changed_.empty()) return;
    }
}

void StateFolder::writeAll(const std::set<std::string>& ids) {
    for (const std::string& id : ids) {
        if (write(id)) {
            if (failed_.erase(id) > 0) spdlog::info("event=state_saved_at_last view={}", id);
        } else if (failed_.insert(id).second) {
            spdlog::error(R"(event=state_not_saved file="{}/{}" error="{}")", path_, id + kSuffix,
                          std::strerror(errno));
        }
    }
}

bool StateFolder::write(const std::string& id) const {
    const std::string name = id + kSuffix;
    const auto view = source_(id);
    if (view) return replace(name, toJson(*view));
    if (::unlinkat(folder_.get(), name.c_str(), 0) != 0) return errno == ENOENT;
    return ::fsync(folder_.get()) == 0;
}

bool StateFolder::replace(const std::string& name, const std::string& text) const {
    const std::string temporary = name.substr(0, name.size() - std::strlen(kSuffix)) + kTemporary;
    const base::FileDescriptor file{::openat(folder_.get(), temporary.c_str(),
                                             O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW,
                                             0600)};
    if (!file.valid()) return false;
    for (std::size_t done = 0; done < text.size();) {
        const auto count = ::write(file.get(), text.data() + done, text.size() - done);
        if (count <= 0) return false;
        done += static_cast<std::size_t>(count);
    }
    // A crash leaves the old file or the new one, never a part.
    return ::fsync(file.get()) == 0 &&
           ::renameat(folder_.get(), temporary.c_str(), folder_.get(), name.c_str()) == 0 &&
           ::fsync(folder_.get()) == 0;
}

}  // namespace volcast::session
