#include "server/video/image_check.h"

#include <string>

namespace volcast::video {

Result<void> check(const ImageView& image) {
    const auto [width, height] = std::pair{image.size.x, image.size.y};
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
        return fail(ErrorCode::kInvalidArgument, "picture of " + size +
                                                     " pixels: each side must be in [1, " +
                                                     std::to_string(kMaxSide) + "]");
    }
    const std::size_t expected =
        std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (image.rgba.size() != expected) {
        return fail(ErrorCode::kInvalidArgument,
                    "picture of " + size + " pixels: got " + std::to_string(image.rgba.size()) +
                        " bytes, expected " + std::to_string(expected));
    }
    return {};
}

}  // namespace volcast::video
