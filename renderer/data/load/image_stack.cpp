#include "renderer/data/load/image_stack.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <OpenImageIO/imageio.h>

#include "renderer/data/load/file.h"
#include "renderer/data/load/formats.h"
#include "renderer/data/load/tiff_pages.h"

namespace volcast::data::load {

namespace {

namespace fs = std::filesystem;

bool isImage(const fs::path& path) {
    const Format* format = formatOf(path.string());
    return format != nullptr && format->family == Family::kImages;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Compares names with the numbers in them as numbers: slice2 stands before slice10.
bool numberedLess(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!isDigit(a[i]) || !isDigit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i;
            ++j;
            continue;
        }
        const auto digits = [](const std::string& text, std::size_t& at) {
            while (at < text.size() && text[at] == '0') ++at;
            const std::size_t start = at;
            while (at < text.size() && isDigit(text[at])) ++at;
            return text.substr(start, at - start);
        };
        const std::string left = digits(a, i);
        const std::string right = digits(b, j);
        if (left.size() != right.size()) return left.size() < right.size();
        if (left != right) return left < right;
    }
    return a.size() - i < b.size() - j;
}

/// The name without its last number: files of one series have the same.
std::string seriesOf(const fs::path& path) {
    std::string stem = path.stem().string();
    std::size_t end = stem.size();
    while (end > 0 && !isDigit(stem[end - 1])) --end;
    std::size_t start = end;
    while (start > 0 && isDigit(stem[start - 1])) --start;
    return start == end
               ? std::string{}
               : stem.substr(0, start) + "#" + stem.substr(end) + path.extension().string();
}

Result<std::vector<std::string>> imagesOf(const fs::path& folder, const std::string& series) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        const fs::path& path = at->path();
        if (isImage(path) && (series.empty() || seriesOf(path) == series)) {
            files.push_back(path.string());
        }
    }
    if (error) return fail(ErrorCode::kIo, folder.string() + ": " + error.message());
    std::sort(files.begin(), files.end(), numberedLess);
    return files;
}

/// The files that make up the stack, in order.
Result<std::vector<std::string>> slicesOf(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        auto files = imagesOf(path, {});
        if (files && files->empty()) {
            return fail(ErrorCode::kUnsupported, path + ": has no TIFF or PNG pictures");
        }
        return files;
    }
    const std::string series = seriesOf(path);
    if (series.empty()) return std::vector<std::string>{path};
    const fs::path folder = fs::path{path}.parent_path();
    return imagesOf(folder.empty() ? fs::path{"."} : folder, series);
}

using Input = std::unique_ptr<OIIO::ImageInput>;

Result<Input> openImage(const std::string& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        return fail(ErrorCode::kInvalidArgument, path + ": is not a plain file");
    }
    if (fs::file_size(path, error) == 0 && !error) {
        return fail(ErrorCode::kInvalidArgument, path + ": is empty");
    }
    // By format and not by content: a file called .tif that is something else is refused.
    const bool tiff = formatOf(path)->name == "TIFF";
    Input input = OIIO::ImageInput::create(tiff ? "tiff" : "png");
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec)) {
        const std::string reason = input ? input->geterror() : OIIO::geterror();
        return fail(ErrorCode::kInvalidArgument,
                    path + ": cannot be read as " + (tiff ? "TIFF" : "PNG") +
                        (reason.empty() ? std::string{} : " (" + reason + ")"));
    }
    return input;
}

struct Stack {
    VolumeInput volume = {};
    OIIO::TypeDesc type = {};      ///< As kept.
    OIIO::TypeDesc fileType = {};  ///< As it stands in the first slice.
    int parts = 0;
    std::uint64_t maxBytes = 0;
    std::uint64_t bytes = 0;
};

/// The voxel type that keeps `type`, or float for the others.
std::pair<VoxelType, OIIO::TypeDesc> kept(const OIIO::TypeDesc& type) {
    if (type == OIIO::TypeDesc::UINT8) return {VoxelType::kU8, type};
    if (type == OIIO::TypeDesc::UINT16) return {VoxelType::kU16, type};
    if (type == OIIO::TypeDesc::INT16) return {VoxelType::kI16, type};
    return {VoxelType::kF32, OIIO::TypeDesc::FLOAT};
}

void start(const OIIO::ImageSpec& spec, Stack& stack, std::vector<std::string>& warnings) {
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

Result<void> check(const std::string& path, const OIIO::ImageSpec& spec, const Stack& stack) {
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

/// Refuses a slice with a value that is not finite.
Result<void> checkFinite(const std::string& path, int page, const Stack& stack,
                         const std::vector<std::byte>& slice) {
    if (stack.type != OIIO::TypeDesc::FLOAT) return {};
    const auto parts = static_cast<std::size_t>(stack.parts);
    const auto width = static_cast<std::size_t>(stack.volume.size.x);
    for (std::size_t i = 0; i < slice.size() / sizeof(float); ++i) {
        float value = 0.0F;
        std::memcpy(&value, slice.data() + i * sizeof value, sizeof value);
        if (std::isfinite(value)) continue;
        const std::size_t pixel = i / parts;
        return fail(ErrorCode::kInvalidArgument,
                    path + ": page " + std::to_string(page) + ": pixel (" +
                        std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
                        ") is " + std::to_string(value) + ", not a finite number");
    }
    return {};
}

/// A library's reason in one line.
std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// Appends one slice, its channels taken apart.
Result<void> append(const std::string& path, OIIO::ImageInput& input, int page, Stack& stack) {
    const glm::ivec3 size = stack.volume.size;
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const std::size_t each = stack.type.size();
    const auto parts = static_cast<std::size_t>(stack.parts);
    stack.bytes += 3 * pixels * parts * each;  // The slice, its channels, and room to grow.
    if (stack.bytes > stack.maxBytes) {
        return fail(ErrorCode::kLimitExceeded,
                    path + ": needs more memory than the import may use");
    }
    std::vector<std::byte> slice(pixels * parts * each);
    if (!input.read_image(page, 0, 0, stack.parts, stack.type, slice.data())) {
        return fail(ErrorCode::kInvalidArgument, path + ": page " + std::to_string(page) +
                                                     " cannot be read (" +
                                                     firstLine(input.geterror()) + ")");
    }
    auto finite = checkFinite(path, page, stack, slice);
    if (!finite) return finite;
    for (std::size_t c = 0; c < parts; ++c) {
        std::vector<std::byte>& voxels = stack.volume.channels[c].voxels;
        const std::size_t before = voxels.size();
        voxels.resize(before + pixels * each);
        for (std::size_t i = 0; i < pixels; ++i) {
            std::memcpy(voxels.data() + before + i * each, slice.data() + (i * parts + c) * each,
                        each);
        }
    }
    ++stack.volume.size.z;
    return {};
}

Result<void> appendFile(const std::string& path, Stack& stack, std::vector<std::string>& warnings) {
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
        if (done) done = append(path, **input, page, stack);
        if (!done) return done;
    }
    if (formatOf(path)->name != "TIFF") return {};
    const auto pages = tiffPages(path);
    return pages ? Result<void>{} : pages.error();
}

}  // namespace

Result<Loaded> readImages(const Request& request, const Progress& progress) {
    const auto files = slicesOf(request.path);
    if (!files) return files.error();
    OIIO::attribute("threads", 1);
    Loaded loaded;
    Stack stack{.maxBytes = request.maxMemoryBytes};
    for (std::size_t i = 0; i < files->size(); ++i) {
        auto done = appendFile((*files)[i], stack, loaded.warnings);
        if (!done) return done.error();
        progress("read", static_cast<double>(i + 1) / static_cast<double>(files->size()));
    }
    if (stack.volume.size.z < 2) {
        return fail(ErrorCode::kUnsupported,
                    request.path + ": has one slice; a volume needs at least two");
    }
    for (int axis = 0; axis < 3; ++axis) {
        stack.volume.spacing[axis] = request.spacing[axis] > 0.0 ? request.spacing[axis] : 1.0;
    }
    const std::string name{formatOf(files->front())->name};
    loaded.format = name + (files->size() > 1 ? " stack" : ", several pages");
    loaded.input = std::move(stack.volume);
    return loaded;
}

}  // namespace volcast::data::load
