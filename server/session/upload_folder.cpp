#include "server/session/upload_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <utility>

#include "renderer/base/printable.h"
#include "renderer/data/text.h"
#include "server/session/beneath.h"
#include "server/session/folder_scan.h"

namespace volcast::session {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kPart = ".part.";
constexpr std::size_t kLeastToken = 16, kMostToken = 64;
constexpr int kMostSameNames = 1000;

UploadError refuse(UploadRefusal why, std::string message) {
    return {.why = why, .message = std::move(message)};
}

/// Of the system's latest error.
UploadError systemError(const std::string& about) {
    const bool full = errno == ENOSPC || errno == EDQUOT;
    return refuse(full ? UploadRefusal::kNoRoom : UploadRefusal::kIo,
                  about + ": " + std::strerror(errno));
}

std::string inQuotes(const std::string& name) {
    return '"' + base::printable(name) + '"';
}

std::string mib(std::uint64_t bytes) {
    const std::uint64_t tenths = (bytes * 10) >> 20U;
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MiB";
}

UploadResult<void> checkToken(const std::string& token) {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0; };
    const bool fits = token.size() >= kLeastToken && token.size() <= kMostToken;
    if (fits && std::ranges::all_of(token, allowed)) return boost::system::in_place_value;
    return refuse(UploadRefusal::kBadName, "upload " + inQuotes(token) + ": its token must be " +
                                               std::to_string(kLeastToken) + " to " +
                                               std::to_string(kMostToken) + " letters and digits");
}

/// A name that is one part of a path, not hidden, and can be told to every client.
UploadResult<void> checkName(const std::string& name) {
    const auto bad = [&](const std::string& why) {
        return refuse(UploadRefusal::kBadName, "name " + inQuotes(name) + ": " + why);
    };
    if (name.empty()) return bad("is empty");
    if (name.size() > UploadFolder::kMaxNameBytes) {
        return bad("has " + std::to_string(name.size()) + " bytes; the limit is " +
                   std::to_string(UploadFolder::kMaxNameBytes));
    }
    if (name.front() == '.') return bad("begins with a dot");
    if (!data::isUtf8(name)) return bad("is not UTF-8");
    const bool path = std::ranges::any_of(
        name, [](unsigned char c) { return c == '/' || c == '\\' || c < 0x20 || c == 0x7f; });
    if (path) return bad("holds a slash or a control character");
    return boost::system::in_place_value;
}

struct Contents {
    std::uint64_t bytes = 0;
    std::uint32_t uploads = 0;
};

/// What is in the folder, unfinished uploads included; links are not followed.
Contents count(const std::string& path) {
    Contents all;
    std::error_code ignored;
    for (fs::directory_iterator at{path, ignored}, end; at != end; at.increment(ignored)) {
        ++all.uploads;
    }
    const auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator at{path, options, ignored}, end; at != end;
         at.increment(ignored)) {
        if (at->is_symlink(ignored) || !at->is_regular_file(ignored)) continue;
        const std::uintmax_t size = at->file_size(ignored);
        if (!ignored) all.bytes += size;
    }
    return all;
}

}  // namespace

Result<std::unique_ptr<UploadFolder>> UploadFolder::create(const std::string& dataFolder,
                                                           UploadLimits limits) {
    const auto root = openFolder(dataFolder);
    if (!root) return root.error();
    const std::string path = dataFolder + "/" + kName;
    const auto failed = [&](const std::string& why) {
        return fail(ErrorCode::kIo, "--allow-uploads: " + path + ": " + why);
    };
    if (::mkdirat(root->get(), kName, 0755) != 0 && errno != EEXIST) {
        return failed(std::strerror(errno));
    }
    auto folder = openBeneath(*root, kName, Links::kRefuse);
    if (!folder) return failed("not a folder of the data folder itself");
    struct stat status {};
    if (::fstat(folder->get(), &status) != 0 || !S_ISDIR(status.st_mode)) {
        return failed("is not a folder");
    }
    if (::faccessat(folder->get(), ".", W_OK | X_OK, 0) != 0) return failed(std::strerror(errno));
    std::unique_ptr<UploadFolder> made{new UploadFolder{path, std::move(*folder), limits}};
    made->removeUnfinished();
    return made;
}

UploadFolder::UploadFolder(std::string path, base::FileDescriptor folder, UploadLimits limits)
    : path_{std::move(path)}, folder_{std::move(folder)}, limits_{limits} {}

std::string UploadFolder::pathOf(const std::string& token) const {
    return path_ + "/." + token;
}

void UploadFolder::removeUnfinished() {
    std::error_code ignored;
    std::vector<fs::path> left;
    for (fs::directory_iterator at{path_, ignored}, end; at != end; at.increment(ignored)) {
        if (at->path().filename().string().front() == '.') left.push_back(at->path());
    }
    for (const fs::path& path : left) fs::remove_all(path, ignored);
}

void UploadFolder::removeStale() {
    const auto before = Clock::now() - kKeepUnfinished;
    std::vector<std::string> stale;
    for (const auto& [token, upload] : uploads_) {
        if (upload.open == 0 && upload.used < before) stale.push_back(token);
    }
    for (const std::string& token : stale) remove(token);
}

void UploadFolder::remove(const std::string& token) {
    std::error_code ignored;
    fs::remove_all(pathOf(token), ignored);
    const auto found = uploads_.find(token);
    totalBytes_ -= std::min(totalBytes_, found->second.bytes);
    uploads_.erase(found);
}

UploadResult<UploadFolder::Upload*> UploadFolder::find(const std::string& token) {
    const auto found = uploads_.find(token);
    if (found != uploads_.end() && !found->second.cancelled) return &found->second;
    return refuse(UploadRefusal::kNotFound,
                  "upload " + inQuotes(token) + ": there is none, or it was cancelled");
}

UploadResult<UploadFolder::Upload*> UploadFolder::findOrMake(const std::string& token) {
    if (uploads_.contains(token)) return find(token);
    const Contents there = count(path_);
    totalBytes_ = there.bytes;
    if (there.uploads >= limits_.maxUploads) {
        return refuse(UploadRefusal::kNoRoom, "this server keeps " +
                                                  std::to_string(limits_.maxUploads) +
                                                  " uploads (--max-uploads), and has them");
    }
    const std::string name = "." + token;
    if (::mkdirat(folder_.get(), name.c_str(), 0755) != 0) {
        return systemError("upload " + inQuotes(token));
    }
    auto folder = openBeneath(folder_, name, Links::kRefuse);
    if (!folder) return refuse(UploadRefusal::kIo, folder.error().message);
    Upload& made = uploads_[token];
    made.folder = std::move(*folder);
    made.used = Clock::now();
    return &made;
}

UploadResult<void> UploadFolder::fits(const Upload& upload, std::uint64_t more) const {
    if (more > limits_.maxBytes || upload.bytes > limits_.maxBytes - more) {
        return refuse(UploadRefusal::kTooLarge, "an upload of " + mib(upload.bytes + more) +
                                                    "; the limit is " + mib(limits_.maxBytes) +
                                                    " (--max-upload-mb)");
    }
    if (totalBytes_ > limits_.maxTotalBytes || more > limits_.maxTotalBytes - totalBytes_) {
        return refuse(UploadRefusal::kNoRoom, "all uploads would take " + mib(totalBytes_ + more) +
                                                  "; the limit is " + mib(limits_.maxTotalBytes) +
                                                  " (--max-uploads-mb)");
    }
    struct statvfs disk {};
    if (::fstatvfs(folder_.get(), &disk) != 0) return systemError("uploads");
    const std::uint64_t free = std::uint64_t{disk.f_bavail} * disk.f_frsize;
    if (free < limits_.keepFreeBytes || free - limits_.keepFreeBytes < more) {
        return refuse(UploadRefusal::kNoRoom, "the server's disk has " + mib(free) +
                                                  " left, of which " + mib(limits_.keepFreeBytes) +
                                                  " stay free (--upload-keep-free-mb)");
    }
    return boost::system::in_place_value;
}

UploadResult<std::unique_ptr<UploadFolder::File>> UploadFolder::begin(
    const std::string& token, const std::string& name, std::optional<std::uint64_t> announced) {
    if (const auto checked = checkToken(token); !checked) return checked.error();
    if (const auto checked = checkName(name); !checked) return checked.error();
    const std::lock_guard lock{mutex_};
    removeStale();
    if (open_ >= limits_.maxAtOnce) {
        return refuse(UploadRefusal::kBusy, "this server receives " +
                                                std::to_string(limits_.maxAtOnce) +
                                                " files at once, the most that it takes; try "
                                                "again later");
    }
    const auto found = findOrMake(token);
    if (!found) return found.error();
    Upload& upload = **found;
    if (upload.files + upload.open >= limits_.maxFiles) {
        return refuse(UploadRefusal::kTooLarge, "an upload of more than " +
                                                    std::to_string(limits_.maxFiles) +
                                                    " files, the most that it may have");
    }
    if (const auto room = fits(upload, announced.value_or(0)); !room) {
        if (upload.files + upload.open == 0) remove(token);
        return room.error();
    }
    const int folder = upload.folder.get();
    const std::string part = kPart + name;
    struct stat status {};
    base::FileDescriptor file;
    if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
        file = base::FileDescriptor{::openat(
            folder, part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644)};
        if (!file.valid() && errno != EEXIST) return systemError("file " + inQuotes(name));
    }
    if (!file.valid()) {
        return refuse(UploadRefusal::kConflict,
                      "file " + inQuotes(name) + ": this upload has one of that name");
    }
    ++upload.open;
    ++open_;
    return std::make_unique<File>(*this, token, name, folder, std::move(file));
}

UploadResult<std::vector<std::string>> UploadFolder::finish(const std::string& token,
                                                            const std::string& name) {
    if (const auto checked = checkName(name); !checked) return checked.error();
    const std::lock_guard lock{mutex_};
    const auto found = find(token);
    if (!found) return found.error();
    if ((*found)->open > 0) {
        return refuse(UploadRefusal::kConflict,
                      "upload " + inQuotes(token) + ": files of it are still being received");
    }
    const auto datasets = scanFolder(pathOf(token), (*found)->folder);
    if (datasets.empty()) {
        return refuse(UploadRefusal::kNothingToRead,
                      "none of the " + std::to_string((*found)->files) + " files of " +
                          inQuotes(name) + " is of a kind that this server reads");
    }
    const std::string hidden = "." + token;
    std::string taken = name;
    for (int i = 2; ::renameat2(folder_.get(), hidden.c_str(), folder_.get(), taken.c_str(),
                                RENAME_NOREPLACE) != 0;
         ++i) {
        if (errno != EEXIST || i > kMostSameNames) return systemError("folder " + inQuotes(taken));
        taken = name + "-" + std::to_string(i);
    }
    uploads_.erase(token);
    std::vector<std::string> ids;
    for (const FoundDataset& dataset : datasets) {
        const std::string folder = std::string{kName} + "/" + taken;
        ids.push_back(dataset.id == "." ? folder : folder + "/" + dataset.id);
    }
    return ids;
}

UploadResult<void> UploadFolder::cancel(const std::string& token) {
    const std::lock_guard lock{mutex_};
    const auto found = find(token);
    if (!found) return found.error();
    (*found)->cancelled = true;
    if ((*found)->open == 0) remove(token);
    return boost::system::in_place_value;
}

UploadResult<void> UploadFolder::take(const std::string& token, std::uint64_t bytes) {
    const std::lock_guard lock{mutex_};
    const auto found = find(token);
    if (!found) return found.error();
    if (const auto room = fits(**found, bytes); !room) return room.error();
    (*found)->bytes += bytes;
    totalBytes_ += bytes;
    return boost::system::in_place_value;
}

void UploadFolder::close(const std::string& token, std::uint64_t bytes, bool complete) {
    const std::lock_guard lock{mutex_};
    Upload& upload = uploads_.at(token);
    --open_;
    --upload.open;
    upload.used = Clock::now();
    if (complete) {
        ++upload.files;
    } else {
        upload.bytes -= bytes;
        totalBytes_ -= std::min(totalBytes_, bytes);
    }
    if (upload.cancelled && upload.open == 0) remove(token);
}

UploadFolder::File::File(UploadFolder& owner, std::string token, std::string name, int folder,
                         base::FileDescriptor file)
    : owner_{owner},
      token_{std::move(token)},
      name_{std::move(name)},
      folder_{folder},
      file_{std::move(file)} {}

UploadFolder::File::~File() {
    if (!complete_) ::unlinkat(folder_, (kPart + name_).c_str(), 0);
    owner_.close(token_, bytes_, complete_);
}

UploadResult<void> UploadFolder::File::write(std::span<const std::byte> bytes) {
    if (const auto taken = owner_.take(token_, bytes.size()); !taken) return taken.error();
    bytes_ += bytes.size();
    while (!bytes.empty()) {
        const ssize_t wrote = ::write(file_.get(), bytes.data(), bytes.size());
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) return systemError("file " + inQuotes(name_));
        bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    }
    return boost::system::in_place_value;
}

UploadResult<void> UploadFolder::File::finish() {
    const std::string part = kPart + name_;
    if (::renameat2(folder_, part.c_str(), folder_, name_.c_str(), RENAME_NOREPLACE) != 0) {
        return systemError("file " + inQuotes(name_));
    }
    complete_ = true;
    return boost::system::in_place_value;
}

}  // namespace volcast::session
