#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh_builder.h"
#include "renderer/data/volume_builder.h"
#include "renderer/data/volume_packer.h"

namespace volcast::data::load {

/// What to read, and how to complete what its files do not say.
struct Request {
    std::string path;                        ///< A file, a folder, "demo:mesh" or "demo:volume".
    std::string tetgenSwitches = "pq1.414";  ///< For surfaces; point sets use none.
    glm::dvec3 spacing{0.0};                 ///< Of image stacks; 0: 1.
    std::uint64_t maxMemoryBytes = std::uint64_t{8} << 30;
    std::string beneath;  ///< The folder that `path` must lie below, links followed; empty: any.
    std::uint64_t maxCpuSeconds = 0;  ///< Of all threads of one process; 0: no limit.
};

/// A file's content before it is made ready to draw.
struct Loaded {
    std::variant<MeshInput, VolumeInput, VolumePacker> input = {};
    std::string format = {};                 ///< As users see it: "VTU", "TetGen", "TIFF stack".
    std::vector<std::string> warnings = {};  ///< What was changed or left out on the way.
};

/// Told how far a stage is, from 0 to 1.
using Progress = std::function<void(const std::string& stage, double fraction)>;

/// Everything that reading `path` touches besides system folders, for the sandbox: its folder.
///
/// Errors: kNotFound, kIo (permission), kUnsupported (no loader takes it), kInvalidArgument (not a
/// plain file or folder); all name the path.
Result<std::vector<std::string>> neededPaths(const std::string& path);

/// True where the format of `path` is read by a Python program, which load() starts.
bool needsPython(const std::string& path);

/// True where `path` is read through OpenImageIO, which only some programs link: it brings 250
/// libraries, 0.2 s and 100 MB with it.
bool needsImages(const std::string& path);

/// readImages() of image_stack.h.
using ImageReader = Result<Loaded> (*)(const Request&, const Progress&);

/// Reads a dataset. Messages of errors start with the file at fault. `readImages` may be null in a
/// program that never reads pictures.
///
/// Errors: kNotFound, kIo, kUnsupported, kInvalidArgument, kLimitExceeded.
Result<Loaded> load(const Request& request, const Progress& progress, ImageReader readImages);

}  // namespace volcast::data::load
