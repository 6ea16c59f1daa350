#include <xxhash.h>

#include "server/video/encoder.h"

namespace volcast::video {

std::uint32_t pixelHash(const ImageView& image) {
    return XXH32(image.rgba.data(), image.rgba.size(), 0);
}

}  // namespace volcast::video
