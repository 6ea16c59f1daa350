#include "renderer/data/load/image_pages.h"

#include <filesystem>

#include "renderer/data/load/formats.h"
#include "renderer/data/load/tiff_pages.h"

namespace volcast::data::load {

namespace {

namespace fs = std::filesystem;

/// The voxel type that keeps `type`, or float for the others.
std::pair<VoxelType, OIIO::TypeDesc> kept(const OIIO::TypeDesc& type) {
    if (type == OIIO::TypeDesc::UINT8) return {VoxelType::kU8, type};
    if (type == OIIO::TypeDesc::UINT16) return {VoxelType::kU16, type};
    if (type == OIIO::TypeDesc::INT16) return {VoxelType::kI16, type};
    return {VoxelType::kF32, OIIO::TypeDesc::FLOAT};
}

void start(const OIIO::ImageSpec& spec, ImagePages& stack, std::vector<std::string>& warnings) {
    const auto [voxels, type] = kept(spec.format);
    stack.type = type;
    stack.fileType = spec.format;
    stack.parts = spec.nchannels;
    stack.volume.type = voxels;
    stack.volume.size = {spec.width, spec.height, 0};
    if (type != spec.format) {
        warnings.push_back("pixels of type " + std::string{spec.format.c_str()} +
                           " are kept as float32" +
                           (spec.format.is_floating_point() ? "" : ", scaled to 0 to 1"));
    }
    for (int c = 0; c < spec.nchannels; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const std::string name = i < spec.channelnames.size() ? spec.channelnames[i] : "";
        stack.volume.channels.push_back({.name = spec.nchannels == 1 ? "value"
                                                 : name.empty() ? "channel_" + std::to_string(c)
                                                                : name});
    }
}

Result<void> check(const std::string& path, const OIIO::ImageSpec& spec, const ImagePages& stack) {
    const glm::ivec3 size = stack.volume.size;
    if (spec.width != size.x || spec.height != size.y || spec.nchannels != stack.parts) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ": is " + std::to_string(spec.width) + " x " +
                        std::to_string(spec.height) + " with " + std::to_string(spec.nchannels) +
                        " channels, the first slice is " + std::to_string(size.x) + " x " +
                        std::to_string(size.y) + " with " + std::to_string(stack.parts));
    }
    if (spec.format != stack.fileType) {  // It would be stretched to the range of the first.
        return fail(ErrorCode::kInvalidArgument,
                    path + ": has pixels of type " + spec.format.c_str() +
                        ", those of the first slice are " + stack.fileType.c_str());
    }
    if (size.x > kMaxVolumeSide || size.y > kMaxVolumeSide || size.z >= kMaxVolumeSide) {
        return fail(ErrorCode::kLimitExceeded, path + ": more than " +
                                                   std::to_string(kMaxVolumeSide) +
                                                   " pixels or slices along a side");
    }
    return {};
}

/// Of a page as voxels, with its part of the pyramid.
std::uint64_t bytesOf(const OIIO::ImageSpec& spec, const ImagePages& stack) {
    const std::uint64_t voxels =
        spec.image_pixels() * static_cast<std::uint64_t>(stack.parts) * stack.type.size();
    return voxels + voxels / 7;
}

Result<void> appendFile(const std::string& path, std::uint64_t maxBytes, ImagePages& stack,
                        std::vector<std::string>& warnings) {
    auto input = openImage(path);
    if (!input) return input.error();
    for (int page = 0; (*input)->seek_subimage(page, 0); ++page) {
        const OIIO::ImageSpec spec = (*input)->spec();
        // A picture of many pixels in a file of few bytes is a trap; TIFF and PNG pack 1100 : 1.
        constexpr double kLargestRatio = 1100.0;
        std::error_code ignored;
        const auto fileBytes = static_cast<double>(fs::file_size(path, ignored));
        if (static_cast<double>(spec.image_bytes(true)) > kLargestRatio * fileBytes) {
            return fail(ErrorCode::kLimitExceeded,
                        path + ": says " + std::to_string(spec.width) + " x " +
                            std::to_string(spec.height) + " pixels, which " +
                            std::to_string(static_cast<std::uint64_t>(fileBytes)) +
                            " bytes cannot hold");
        }
        if (stack.parts == 0) start(spec, stack, warnings);
        auto done = check(path, spec, stack);
        if (!done) return done;
        stack.bytes += bytesOf(spec, stack);
        if (stack.bytes > maxBytes) {
            return fail(ErrorCode::kLimitExceeded,
                        path + ": needs more memory than the import may use");
        }
        stack.pages.push_back({.path = path, .page = page, .corner = {spec.x, spec.y}});
        ++stack.volume.size.z;
    }
    if (formatOf(path)->name != "TIFF") return {};
    const auto pages = tiffPages(path, kMaxVolumeSide);
    return pages ? Result<void>{} : pages.error();
}

}  // namespace

Result<ImageInput> openImage(const std::string& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        return fail(ErrorCode::kInvalidArgument, path + ": is not a plain file");
    }
    if (fs::file_size(path, error) == 0 && !error) {
        return fail(ErrorCode::kInvalidArgument, path + ": is empty");
    }
    // By format and not by content: a file called .tif that is something else is refused.
    const bool tiff = formatOf(path)->name == "TIFF";
    ImageInput input = OIIO::ImageInput::create(tiff ? "tiff" : "png");
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec)) {
        const std::string reason = input ? input->geterror() : OIIO::geterror();
        return fail(ErrorCode::kInvalidArgument,
                    path + ": cannot be read as " + (tiff ? "TIFF" : "PNG") +
                        (reason.empty() ? std::string{} : " (" + reason + ")"));
    }
    return input;
}

Result<ImagePages> imagePages(const std::vector<std::string>& files, std::uint64_t maxBytes,
                              std::vector<std::string>& warnings) {
    ImagePages stack;
    for (const std::string& file : files) {
        const auto done = appendFile(file, maxBytes, stack, warnings);
        if (!done) return done.error();
    }
    return stack;
}

}  // namespace volcast::data::load
