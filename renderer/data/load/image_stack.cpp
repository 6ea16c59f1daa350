#include "renderer/data/load/image_stack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include <OpenImageIO/imagecache.h>

#include "renderer/data/load/formats.h"
#include "renderer/data/load/image_files.h"
#include "renderer/data/load/image_pages.h"
#include "renderer/data/volume_packer.h"

namespace volcast::data::load {

namespace {

constexpr int kRows = 64;                 // Read at once.
constexpr float kCacheMegabytes = 16.0F;  // Of decoded tiles.

/// Refuses rows from `row` on with a value that is infinite; NaN stands for no value.
Result<void> checkValues(const ImagePage& page, int row, const ImagePages& stack,
                         std::span<const std::byte> rows) {
    if (stack.type != OIIO::TypeDesc::FLOAT) return {};
    const auto parts = static_cast<std::size_t>(stack.parts);
    const auto width = static_cast<std::size_t>(stack.volume.size.x);
    for (std::size_t i = 0; i < rows.size() / sizeof(float); ++i) {
        float value = 0.0F;
        std::memcpy(&value, rows.data() + i * sizeof value, sizeof value);
        if (!std::isinf(value)) continue;
        const std::size_t pixel = i / parts;
        return fail(ErrorCode::kInvalidArgument,
                    page.path + ": page " + std::to_string(page.page) + ": pixel (" +
                        std::to_string(pixel % width) + ", " +
                        std::to_string(static_cast<std::size_t>(row) + pixel / width) + ") is " +
                        std::to_string(value) +
                        "; values are finite numbers, or NaN where there is none");
    }
    return {};
}

/// A library's reason in one line.
std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// Pixels of pages. Types that OpenImageIO's cache keeps as they are come through it: tile by tile,
/// or strip by strip, within a limit of memory. It would turn others into floats, so these are read
/// page by page.
class PageReader {
public:
    explicit PageReader(const ImagePages& stack)
        : stack_{stack}, cache_{OIIO::ImageCache::create(false)} {
        cache_->attribute("max_memory_MB", kCacheMegabytes);
        cache_->attribute("autotile", kRows);
        cache_->attribute("autoscanline", 1);
    }
    PageReader(const PageReader&) = delete;
    PageReader& operator=(const PageReader&) = delete;
    PageReader(PageReader&&) = delete;
    PageReader& operator=(PageReader&&) = delete;
    ~PageReader() { OIIO::ImageCache::destroy(cache_); }

    [[nodiscard]] int rowsAtOnce() const { return cached() ? kRows : stack_.volume.size.y; }

    /// Rows [from, to) of a page, channels side by side.
    Result<void> read(const ImagePage& page, int from, int to, std::span<std::byte> pixels) {
        std::string reason;
        if (cached()) {
            const glm::ivec2 at = page.corner;
            if (cache_->get_pixels(OIIO::ustring{page.path}, page.page, 0, at.x,
                                   at.x + stack_.volume.size.x, at.y + from, at.y + to, 0, 1, 0,
                                   stack_.parts, stack_.type, pixels.data())) {
                return {};
            }
            reason = cache_->geterror();
        } else {
            if (opened_ != page.path) {
                auto input = openImage(page.path);
                if (!input) return input.error();
                input_ = std::move(*input);
                opened_ = page.path;
            }
            if (input_->read_image(page.page, 0, 0, stack_.parts, stack_.type, pixels.data())) {
                return {};
            }
            reason = input_->geterror();
        }
        return fail(ErrorCode::kInvalidArgument, page.path + ": page " + std::to_string(page.page) +
                                                     " cannot be read (" + firstLine(reason) + ")");
    }

private:
    [[nodiscard]] bool cached() const {
        const OIIO::TypeDesc type = stack_.fileType;
        return type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16 ||
               type == OIIO::TypeDesc::HALF || type == OIIO::TypeDesc::FLOAT;
    }

    const ImagePages& stack_;
    OIIO::ImageCache* cache_;
    ImageInput input_;
    std::string opened_;
};

/// Takes the channels of rows apart; `first` is where they begin in each channel, in voxels.
void separate(const ImagePages& stack, std::span<const std::byte> rows, std::size_t first,
              const VolumePacker& packer) {
    const std::size_t each = stack.type.size();
    const auto parts = static_cast<std::size_t>(stack.parts);
    const std::size_t count = rows.size() / (parts * each);
    for (std::size_t c = 0; c < parts; ++c) {
        std::byte* to = packer.voxels(c).data() + first * each;
        for (std::size_t i = 0; i < count; ++i) {
            std::memcpy(to + i * each, rows.data() + (i * parts + c) * each, each);
        }
    }
}

Result<void> readPages(const ImagePages& stack, const glm::ivec3& size, const VolumePacker& packer,
                       const Progress& progress) {
    PageReader reader{stack};
    const std::size_t rowBytes = static_cast<std::size_t>(size.x) *
                                 static_cast<std::size_t>(stack.parts) * stack.type.size();
    std::vector<std::byte> pixels;
    for (int z = 0; z < size.z; ++z) {
        const ImagePage& page = stack.pages[static_cast<std::size_t>(z)];
        for (int from = 0; from < size.y; from += reader.rowsAtOnce()) {
            const int to = std::min(from + reader.rowsAtOnce(), size.y);
            pixels.resize(static_cast<std::size_t>(to - from) * rowBytes);
            Result<void> done = reader.read(page, from, to, pixels);
            if (done) done = checkValues(page, from, stack, pixels);
            if (!done) return done;
            const auto row = static_cast<std::size_t>(z) * size.y + static_cast<std::size_t>(from);
            separate(stack, pixels, row * size.x, packer);
        }
        progress("read", static_cast<double>(z + 1) / size.z);
    }
    return {};
}

}  // namespace

Result<Loaded> readImages(const Request& request, const Progress& progress) {
    const auto files = slicesOf(request.path);
    if (!files) return files.error();
    OIIO::attribute("threads", 1);
    Loaded loaded;
    auto stack = imagePages(*files, request.maxMemoryBytes, loaded.warnings);
    if (!stack) return stack.error();
    if (stack->volume.size.z < 2) {
        return fail(ErrorCode::kUnsupported,
                    request.path + ": has one slice; a volume needs at least two");
    }
    for (int axis = 0; axis < 3; ++axis) {
        stack->volume.spacing[axis] = request.spacing[axis] > 0.0 ? request.spacing[axis] : 1.0;
    }
    auto packer = VolumePacker::create(stack->volume);
    if (!packer) return packer.error();
    const auto read = readPages(*stack, stack->volume.size, *packer, progress);
    if (!read) return read.error();
    const std::string name{formatOf(files->front())->name};
    loaded.format = name + (files->size() > 1 ? " stack" : ", several pages");
    loaded.input = std::move(*packer);
    return loaded;
}

}  // namespace volcast::data::load
