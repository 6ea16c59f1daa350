#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::session {

struct UploadLimits {
    bool needToken = false;  ///< Only who brings an access token of ROLE_CONTROL uploads.
    std::uint64_t maxBytes = std::uint64_t{1} << 30;        ///< Of one upload, all its files.
    std::uint64_t maxTotalBytes = std::uint64_t{10} << 30;  ///< Of all uploads that are there.
    std::uint32_t maxFiles = 4096;                          ///< Of one upload.
    std::uint32_t maxUploads = 100;                         ///< That are there.
    std::uint64_t keepFreeBytes = std::uint64_t{1} << 30;   ///< Of the disk.
    std::uint32_t maxAtOnce = 4;                            ///< Files that are being received.
    std::chrono::seconds patience{20};                      ///< For 64 KiB to arrive.
};

/// Why an upload is refused; the message names the thing, the value and the limit.
enum class UploadRefusal {
    kBadName,
    kTooLarge,
    kNoRoom,  ///< The disk, or the limits of all uploads together.
    kBusy,    ///< Too many at once: later.
    kConflict,
    kNotFound,
    kNothingToRead,  ///< No loader takes any of the files.
    kIo,
};
struct UploadError {
    UploadRefusal why = UploadRefusal::kIo;
    std::string message;
};
template <class T>
using UploadResult = boost::system::result<T, UploadError>;

/// Takes files from clients into the folder "uploads" of the data folder.
///
/// Files that belong together are one upload, under a token that its sender makes up. They gather
/// in a hidden folder, each under a temporary name until all of it is there; finish() renames that
/// folder, so that nobody ever sees half a dataset. Each upload keeps a folder of its own: an
/// import may read the dataset's folder, and so nothing but what came with it.
///
/// Any thread. What a server that ended left unfinished is removed by the next.
class UploadFolder {
public:
    class File;
    static constexpr const char* kName = "uploads";
    static constexpr std::size_t kMaxNameBytes = 200;
    static constexpr std::chrono::minutes kKeepUnfinished{60};

    /// Errors: as openFolder(); kIo where files cannot be made in it, or "uploads" is no folder.
    static Result<std::unique_ptr<UploadFolder>> create(const std::string& dataFolder,
                                                        UploadLimits limits);
    UploadFolder(const UploadFolder&) = delete;
    UploadFolder& operator=(const UploadFolder&) = delete;
    UploadFolder(UploadFolder&&) = delete;
    UploadFolder& operator=(UploadFolder&&) = delete;
    ~UploadFolder() = default;

    /// A new file of the upload `token`, which begins with its first file. `announced`: its size,
    /// where the sender says it; too much is refused before it is sent.
    UploadResult<std::unique_ptr<File>> begin(const std::string& token, const std::string& name,
                                              std::optional<std::uint64_t> announced);
    /// Makes the upload a folder called `name`, or "name-2" and so on where that is taken. Returns
    /// the catalogue's ids of its datasets.
    UploadResult<std::vector<std::string>> finish(const std::string& token,
                                                  const std::string& name);
    /// Removes an unfinished upload; files that are being received end with kNotFound.
    UploadResult<void> cancel(const std::string& token);
    [[nodiscard]] const UploadLimits& limits() const noexcept { return limits_; }

private:
    struct Upload {
        base::FileDescriptor folder;
        std::uint64_t bytes = 0;
        std::uint32_t files = 0;  ///< Complete ones.
        std::uint32_t open = 0;
        bool cancelled = false;
        std::chrono::steady_clock::time_point used{};
    };

    UploadFolder(std::string path, base::FileDescriptor folder, UploadLimits limits);
    [[nodiscard]] std::string pathOf(const std::string& token) const;
    void removeUnfinished();
    void removeStale();
    void remove(const std::string& token);
    [[nodiscard]] UploadResult<Upload*> find(const std::string& token);
    [[nodiscard]] UploadResult<Upload*> findOrMake(const std::string& token);
    /// Whether `more` bytes fit within the limits and on the disk.
    [[nodiscard]] UploadResult<void> fits(const Upload& upload, std::uint64_t more) const;
    UploadResult<void> take(const std::string& token, std::uint64_t bytes);
    void close(const std::string& token, std::uint64_t bytes, bool complete);

    const std::string path_;  ///< Of "uploads".
    const base::FileDescriptor folder_;
    const UploadLimits limits_;
    std::mutex mutex_;
    std::map<std::string, Upload> uploads_;  ///< Unfinished ones.
    std::uint64_t totalBytes_ = 0;           ///< Of all, finished or not; counted anew with each.
    std::uint32_t open_ = 0;
};

/// A file that is being received; without finish() it is removed again.
class UploadFolder::File {
public:
    File(UploadFolder& owner, std::string token, std::string name, int folder,
         base::FileDescriptor file);
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    File(File&&) = delete;
    File& operator=(File&&) = delete;
    ~File();

    UploadResult<void> write(std::span<const std::byte> bytes);
    /// Gives it its name.
    UploadResult<void> finish();
    [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }

private:
    UploadFolder& owner_;
    const std::string token_, name_;
    const int folder_;
    base::FileDescriptor file_;
    std::uint64_t bytes_ = 0;
    bool complete_ = false;
};

}  // namespace volcast::session
