#include "renderer/data/load/tiff_pages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fcntl.h>
#include <unistd.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::data::load {

namespace {

/// Reads numbers of the file's byte order.
class TiffFile {
public:
    explicit TiffFile(const std::string& path)
        : file_{::open(path.c_str(), O_RDONLY | O_CLOEXEC)} {}

    [[nodiscard]] bool good() const { return good_ && file_.valid(); }
    void setBigEndian(bool big) { bigEndian_ = big; }

    /// The number of `size` bytes, at most 8, at `offset`; 0, and good() false, behind the file's
    /// end.
    std::uint64_t number(std::uint64_t offset, unsigned size) {
        std::array<unsigned char, 8> bytes{};
        const auto at = static_cast<off_t>(offset);
        if (at < 0 || ::pread(file_.get(), bytes.data(), size, at) != static_cast<ssize_t>(size)) {
            good_ = false;
            return 0;
        }
        std::uint64_t value = 0;
        for (unsigned i = 0; i < size; ++i) {
            value |= std::uint64_t{bytes.at(i)} << (8 * (bigEndian_ ? size - 1 - i : i));
        }
        return value;
    }

private:
    base::FileDescriptor file_;
    bool good_ = true;
    bool bigEndian_ = false;
};

}  // namespace

Result<int> tiffPages(const std::string& path, int mostPages) {
    TiffFile file{path};
    if (!file.good()) return fail(ErrorCode::kIo, path + ": cannot be opened");
    file.setBigEndian(file.number(0, 2) == 0x4d4d);
    const bool big = file.number(2, 2) == 43;
    const unsigned offsetSize = big ? 8 : 4;
    const unsigned countSize = big ? 8 : 2;
    const unsigned entrySize = big ? 20 : 12;
    std::uint64_t directory = file.number(big ? 8 : 4, offsetSize);
    if (!file.good()) {
        return fail(ErrorCode::kInvalidArgument, path + ": is cut off within its header");
    }
    int pages = 0;
    for (; directory != 0; ++pages) {
        if (pages == mostPages) {
            return fail(ErrorCode::kLimitExceeded,
                        path + ": has more than " + std::to_string(mostPages) +
                            " pages, or pages that lead back to one before");
        }
        constexpr std::uint64_t kMaxEntries = 1 << 16;
        const std::uint64_t entries = std::min(file.number(directory, countSize), kMaxEntries);
        directory = file.number(directory + countSize + entries * entrySize, offsetSize);
        if (!file.good()) {
            return fail(
                ErrorCode::kInvalidArgument,
                path + ": is cut off: page " + std::to_string(pages) + " lies behind its end");
        }
    }
    return pages;
}

}  // namespace volcast::data::load
