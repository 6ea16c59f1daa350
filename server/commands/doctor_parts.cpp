#include <array>
#include <functional>

#include "renderer/base/sandbox.h"
#include "server/commands/child_output.h"
#include "server/commands/findings.h"
#include "server/video/colour_patch.h"
#include "server/video/video_stream.h"
#include "server/workers/child_process.h"
#include "server/workers/import_service.h"

namespace volcast::commands {

namespace {

/// Python modules by what they read.
struct Reader {
    const char* module;
    const char* formats;
    const char* package;
};
constexpr std::array kReaders{
    Reader{"vtkmodules.vtkIOXML", "VTU, VTI", "python3-vtk9"},
    Reader{"vtkmodules.vtkIOLegacy", "legacy VTK", "python3-vtk9"},
    Reader{"vtkmodules.vtkIOExodus", "Exodus", "python3-vtk9"},
    Reader{"numpy", "MHD, NRRD, NIfTI", "python3-numpy"},
    Reader{"h5py", "XDMF", "python3-h5py"},
    Reader{"meshio", "Gmsh", "python3-meshio"},
};

Finding program(const std::string& name, bool required, const std::string& cost) {
    const auto output = outputOf(workers::besideThisProgram(name), {"--help"});
    const bool ok = output && output->succeeded;
    std::string detail = "starts";
    if (!output) detail = output.error().message;
    if (output && !output->succeeded) detail = name + " " + output->ending;
    return {.group = "import",
            .name = name,
            .ok = ok,
            .required = required,
            .detail = detail,
            .cost = cost};
}

Finding python(const Reader& reader) {
    // The module is loaded, not only found: a broken installation counts as missing.
    const auto output =
        outputOf("/usr/bin/python3", {"-c", "import " + std::string{reader.module}});
    const bool ok = output && output->succeeded;
    return {
        .group = "import",
        .name = reader.formats,
        .ok = ok,
        .required = false,
        .detail =
            std::string{"python module "} + reader.module +
            (ok ? "" : " cannot be loaded; it is in the package " + std::string{reader.package}),
        .cost = std::string{reader.formats} + " files cannot be read"};
}

}  // namespace

std::vector<Finding> findCodecs() {
    struct Row {
        const char* name;
        bool required;
        const char* cost;
        std::function<Result<std::vector<std::byte>>(const video::ImageView&)> encode;
    };
    const std::array rows{
        Row{"JPEG 4:4:4", true, "no pictures while things move",
            [](const video::ImageView& image) { return video::encodeJpeg(image); }},
        Row{"PNG", true, "no exact pictures once things rest", video::encodePng},
        Row{"WebP lossless", false, "clients that have no PNG get no exact pictures",
            video::encodeWebp},
    };
    std::vector<Finding> findings;
    for (const Row& row : rows) {
        const auto bytes = row.encode(video::colourPatch());
        findings.push_back({.group = "codecs",
                            .name = row.name,
                            .ok = bytes.has_value(),
                            .required = row.required,
                            .detail = bytes ? "encodes" : bytes.error().message,
                            .cost = row.cost});
    }
    for (const video::EncoderFinding& encoder : video::findVideoEncoders()) {
        const bool vp9 = encoder.codec == video::VideoCodec::kVp9;
        findings.push_back({.group = "codecs",
                            .name = (vp9 ? "VP9 4:4:4, " : "H.264, ") + encoder.name,
                            .ok = encoder.works,
                            .required = false,
                            .detail = encoder.detail + (encoder.used    ? ", and is used"
                                                        : encoder.works ? "; one before it is used"
                                                                        : ""),
                            .cost = encoder.hardware ? "H.264 is encoded on the CPU"
                                    : vp9            ? "slow connections get H.264 or JPEG"
                                                     : "slow connections get VP9 or JPEG"});
    }
    return findings;
}

std::vector<Finding> findImportFormats() {
    std::vector<Finding> findings;
    findings.push_back(program("volcast-import", true, "no data can be read"));
    workers::ImportRequest request;
    request.path = "demo:mesh";
    const auto demo = workers::runImport(request, {}, {});
    findings.push_back(
        {.group = "import",
         .name = "TetGen",
         .ok = demo.has_value(),
         .required = true,
         .detail = demo ? "made the demo mesh of " + std::to_string(demo->summary.cells) + " cells"
                        : demo.error().message,
         .cost = "surfaces and point sets cannot be filled with cells"});
    findings.push_back(program("volcast-import-images", false,
                               "TIFF and other image stacks cannot be read (OpenImageIO)"));
    for (const Reader& reader : kReaders) findings.push_back(python(reader));
    return findings;
}

std::vector<Finding> findSandbox() {
    const base::SandboxFeatures features = base::sandboxFeatures();
    const int abi = features.landlockAbi;
    return {{.group = "sandbox",
             .name = "seccomp",
             .ok = features.seccomp,
             .required = true,
             .detail = features.seccomp ? "filters are granted" : "this kernel has no filters",
             .cost = "workers and importers refuse to start"},
            {.group = "sandbox",
             .name = "no new privileges",
             .ok = features.noNewPrivileges,
             .required = true,
             .detail = features.noNewPrivileges ? "granted" : "refused",
             .cost = "workers and importers refuse to start"},
            {.group = "sandbox",
             .name = "Landlock files",
             .ok = abi >= 1,
             .required = false,
             .detail = abi >= 1 ? "version " + std::to_string(abi) : "not in this kernel",
             .cost = "a hostile file that takes over an importer can read the user's other files"},
            {.group = "sandbox",
             .name = "Landlock network",
             .ok = abi >= 4,
             .required = false,
             .detail = abi >= 4 ? "granted" : "needs version 4, Linux 6.7",
             .cost = "the network is denied by seccomp alone"}};
}

}  // namespace volcast::commands
