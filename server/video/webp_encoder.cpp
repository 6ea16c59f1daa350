#include <memory>
#include <string>

#include <webp/encode.h>

#include "server/video/encoder.h"
#include "server/video/image_check.h"

namespace volcast::video {

namespace {

constexpr int kFastest = 0;  // Of 0 to 9; higher levels shrink little for many times the work.

struct PictureDeleter {
    void operator()(WebPPicture* picture) const noexcept { WebPPictureFree(picture); }
};
struct WriterDeleter {
    void operator()(WebPMemoryWriter* writer) const noexcept { WebPMemoryWriterClear(writer); }
};

}  // namespace

Result<std::vector<std::byte>> encodeWebp(const ImageView& image) {
    if (Result<void> valid = check(image); !valid) return std::move(valid).error();
    if (image.size.x > WEBP_MAX_DIMENSION || image.size.y > WEBP_MAX_DIMENSION) {
        return fail(ErrorCode::kInvalidArgument, "picture of " + std::to_string(image.size.x) +
                                                     " x " + std::to_string(image.size.y) +
                                                     " pixels: WebP allows sides of at most " +
                                                     std::to_string(WEBP_MAX_DIMENSION));
    }
    WebPConfig config;
    WebPPicture picture;
    if (WebPConfigInit(&config) == 0 || WebPConfigLosslessPreset(&config, kFastest) == 0 ||
        WebPPictureInit(&picture) == 0) {
        return fail(ErrorCode::kUnsupported, "WebP: the library is of another version");
    }
    config.exact = 1;  // Colours of transparent pixels are kept, too.
    const std::unique_ptr<WebPPicture, PictureDeleter> ownedPicture{&picture};
    picture.use_argb = 1;
    picture.width = image.size.x;
    picture.height = image.size.y;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    const std::unique_ptr<WebPMemoryWriter, WriterDeleter> ownedWriter{&writer};
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const auto* rgba = reinterpret_cast<const std::uint8_t*>(image.rgba.data());
    if (WebPPictureImportRGBA(&picture, rgba, image.size.x * 4) == 0 ||
        WebPEncode(&config, &picture) == 0) {
        return fail(ErrorCode::kIo, "WebP: error " + std::to_string(picture.error_code));
    }
    const auto* first = reinterpret_cast<const std::byte*>(writer.mem);
    return std::vector<std::byte>(first, first + writer.size);
}

}  // namespace volcast::video
