#include "renderer/data/load/tiff_pages.h"

#include <algorithm>
#include <cstdint>
#include <fstream>

namespace volcast::data::load {

namespace {

/// Reads numbers of the file's byte order.
class TiffFile {
public:
    explicit TiffFile(const std::string& path) : file_{path, std::ios::binary} {}

    [[nodiscard]] bool good() const { return file_.good(); }
    void setBigEndian(bool big) { bigEndian_ = big; }

    /// The number of `size` bytes at `offset`; 0, and good() false, behind the file's end.
    std::uint64_t number(std::uint64_t offset, unsigned size) {
        std::uint64_t value = 0;
        file_.seekg(static_cast<std::streamoff>(offset));
        for (unsigned i = 0; i < size; ++i) {
            const auto byte = static_cast<std::uint64_t>(file_.get() & 0xff);
            value |= byte << (8 * (bigEndian_ ? size - 1 - i : i));
        }
        return value;
    }

private:
    std::ifstream file_;
    bool bigEndian_ = false;
};

}  // namespace

Result<int> tiffPages(const std::string& path) {
    TiffFile file{path};
    if (!file.good()) return fail(ErrorCode::kIo, path + ": cannot be opened");
    file.setBigEndian(file.number(0, 2) == 0x4d4d);
    const bool big = file.number(2, 2) == 43;
    const unsigned offsetSize = big ? 8 : 4;
    const unsigned countSize = big ? 8 : 2;
    const unsigned entrySize = big ? 20 : 12;
    std::uint64_t directory = file.number(big ? 8 : 4, offsetSize);
    constexpr int kMaxPages = 1 << 16;
    int pages = 0;
    for (; directory != 0 && pages < kMaxPages; ++pages) {
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
