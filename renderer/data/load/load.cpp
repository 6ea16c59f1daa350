#include "renderer/data/load/load.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include "renderer/data/load/demo.h"
#include "renderer/data/load/formats.h"
#include "renderer/data/load/python_reader.h"
#include "renderer/data/load/surface_files.h"
#include "renderer/data/load/tetgen_mesh.h"

namespace volcast::data::load {

namespace {

namespace fs = std::filesystem;

bool isDemo(const std::string& path) {
    return path.starts_with("demo:");
}

Error systemError(const std::string& path) {
    const ErrorCode code =
        errno == ENOENT || errno == ENOTDIR ? ErrorCode::kNotFound : ErrorCode::kIo;
    return fail(code, path + ": " + std::strerror(errno));
}

std::string suffixes() {
    std::string list;
    for (const Format& format : kFormats) {
        if (!list.empty()) list += ' ';
        list += format.suffix;
    }
    return list;
}

Error unknownFormat(const std::string& path) {
    return fail(ErrorCode::kUnsupported, path + ": no loader takes this kind of file; there are " +
                                             suffixes() + " and folders of pictures");
}

Result<Loaded> loadDemo(const std::string& path) {
    if (path == "demo:mesh") return demoMesh();
    if (path == "demo:volume") return demoVolume();
    return fail(ErrorCode::kNotFound, path + ": there are demo:mesh and demo:volume");
}

}  // namespace

Result<std::vector<std::string>> neededPaths(const std::string& path) {
    if (isDemo(path)) return std::vector<std::string>{};
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0) return systemError(path);
    const bool folder = S_ISDIR(info.st_mode);
    if (!folder && !S_ISREG(info.st_mode)) {
        return fail(ErrorCode::kInvalidArgument, path + ": is neither a plain file nor a folder");
    }
    if (!folder && formatOf(path) == nullptr) return unknownFormat(path);
    if (::access(path.c_str(), R_OK) != 0) return systemError(path);
    if (!folder && info.st_size == 0) {
        return fail(ErrorCode::kInvalidArgument, path + ": is empty");
    }
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (error) return fail(ErrorCode::kIo, path + ": " + error.message());
    if (folder) return std::vector<std::string>{real.string()};
    // The folder that the name lies in and, of a link, the one it leads to.
    const fs::path named = fs::absolute(path).parent_path();
    return std::vector<std::string>{named.string(), real.parent_path().string()};
}

bool needsPython(const std::string& path) {
    const Format* format = isDemo(path) ? nullptr : formatOf(path);
    if (format == nullptr) return false;
    std::error_code error;
    if (fs::is_directory(path, error)) return false;
    return format->family == Family::kVtk || format->family == Family::kGrid ||
           format->family == Family::kMeshio;
}

bool needsImages(const std::string& path) {
    if (isDemo(path)) return false;
    std::error_code error;
    if (fs::is_directory(path, error)) return true;
    const Format* format = formatOf(path);
    return format != nullptr && format->family == Family::kImages;
}

Result<Loaded> load(const Request& request, const Progress& progress, ImageReader readImages) {
    progress("read", 0.0);
    if (isDemo(request.path)) return loadDemo(request.path);
    if (needsImages(request.path)) {
        if (readImages != nullptr) return readImages(request, progress);
        return fail(ErrorCode::kUnsupported,
                    request.path + ": this program was built without OpenImageIO");
    }
    const Format* format = formatOf(request.path);
    if (format == nullptr) return unknownFormat(request.path);
    switch (format->family) {
        case Family::kTetgenMesh: return readTetgenMesh(request, progress);
        case Family::kSurface: return readSurface(request, progress);
        case Family::kImages: break;  // Above.
        case Family::kVtk:
        case Family::kGrid:
        case Family::kMeshio: return readWithPython(*format, request, progress);
    }
    return unknownFormat(request.path);
}

}  // namespace volcast::data::load
