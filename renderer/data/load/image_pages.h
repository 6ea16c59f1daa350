#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "renderer/base/result.h"
#include "renderer/data/volume_builder.h"

namespace volcast::data::load {

using ImageInput = std::unique_ptr<OIIO::ImageInput>;

/// A file that is by its name and by its content a TIFF or PNG.
///
/// Errors: kInvalidArgument.
Result<ImageInput> openImage(const std::string& path);

struct ImagePage {
    std::string path;
    int page = 0;
    glm::ivec2 corner{0};  ///< Coordinates of its first pixel, as OpenImageIO counts them.
};

/// The slices of a stack of pictures, none of which has been read yet: all alike.
struct ImagePages {
    VolumeInput volume = {};       ///< Size, type and channels without voxels.
    OIIO::TypeDesc type = {};      ///< As kept.
    OIIO::TypeDesc fileType = {};  ///< As it stands in the first slice.
    int parts = 0;                 ///< Channels.
    std::uint64_t bytes = 0;       ///< As voxels with a pyramid.
    std::vector<ImagePage> pages = {};
};

/// The pages of `files`, one after the other, by their headers alone; says in `warnings` what is
/// converted.
///
/// Errors: kInvalidArgument (a damaged header, one that differs from the first), kLimitExceeded (a
/// header that says more than the file can hold, more than `maxBytes`).
Result<ImagePages> imagePages(const std::vector<std::string>& files, std::uint64_t maxBytes,
                              std::vector<std::string>& warnings);

}  // namespace volcast::data::load
