#pragma once

#include <filesystem>
#include <utility>

#include "renderer/base/result.h"

namespace volcast::workers {

/// Owns a temporary folder that only this user can enter; removed with all in it at the end.
class PrivateFolder {
public:
    PrivateFolder() = default;
    /// Made in $TMPDIR, else /tmp. Errors: kIo naming the folder.
    static Result<PrivateFolder> create();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    PrivateFolder(PrivateFolder&& other) noexcept : path_{std::exchange(other.path_, {})} {}
    PrivateFolder& operator=(PrivateFolder&& other) noexcept {
        std::swap(path_, other.path_);
        return *this;
    }
    ~PrivateFolder();

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace volcast::workers
