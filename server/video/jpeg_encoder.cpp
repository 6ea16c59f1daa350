#include <memory>
#include <string>

#include <turbojpeg.h>

#include "server/video/encoder.h"
#include "server/video/image_check.h"

namespace volcast::video {

namespace {

struct CompressorDeleter {
    void operator()(void* compressor) const noexcept { tjDestroy(compressor); }
};
struct BufferDeleter {
    void operator()(unsigned char* bytes) const noexcept { tjFree(bytes); }
};

/// One compressor a thread: making one costs as much as a small picture.
tjhandle threadCompressor() {
    thread_local const std::unique_ptr<void, CompressorDeleter> compressor{tjInitCompress()};
    return compressor.get();
}

}  // namespace

Result<std::vector<std::byte>> encodeJpeg(const ImageView& image, int quality) {
    if (Result<void> valid = check(image); !valid) return std::move(valid).error();
    if (quality < 1 || quality > 100) {
        return fail(ErrorCode::kInvalidArgument,
                    "JPEG quality " + std::to_string(quality) + " is outside [1, 100]");
    }
    tjhandle compressor = threadCompressor();
    if (compressor == nullptr) return fail(ErrorCode::kIo, "JPEG: no memory for a compressor");
    unsigned char* bytes = nullptr;  // Allocated by the library, which knows how much it needs.
    unsigned long size = 0;
    const int failed = tjCompress2(
        compressor, reinterpret_cast<const unsigned char*>(image.rgba.data()), image.size.x, 0,
        image.size.y, TJPF_RGBX, &bytes, &size, TJSAMP_444, quality, TJFLAG_ACCURATEDCT);
    const std::unique_ptr<unsigned char, BufferDeleter> owned{bytes};
    if (failed != 0)
        return fail(ErrorCode::kIo, std::string{"JPEG: "} + tjGetErrorStr2(compressor));
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    return std::vector<std::byte>(first, first + size);
}

}  // namespace volcast::video
