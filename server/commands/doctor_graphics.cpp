#include <boost/json.hpp>

#include "renderer/scene/default_scene.h"
#include "server/commands/cache_folder.h"
#include "server/commands/child_output.h"
#include "server/commands/findings.h"
#include "server/commands/offline_renderer.h"
#include "server/workers/child_process.h"
#include "server/workers/gpu_given_up.h"
#include "server/workers/import_service.h"

namespace volcast::commands {

namespace {

namespace json = boost::json;

/// What `volcast-worker --probe` prints for one device.
Result<json::object> probe(const std::string& gpu) {
    std::vector<std::string> arguments{"--probe"};
    if (!gpu.empty()) arguments.insert(arguments.end(), {"--gpu", gpu});
    auto output = outputOf(workers::besideThisProgram("volcast-worker"), arguments);
    if (!output) return std::move(output).error();
    if (!output->succeeded) return fail(ErrorCode::kIo, "the probe " + output->ending);
    boost::system::error_code error;
    const json::value value = json::parse(output->text, error);
    if (error || !value.is_object()) return fail(ErrorCode::kIo, "the probe printed no JSON");
    return value.get_object();
}

std::string text(const json::object& object, const char* key) {
    const json::value* value = object.if_contains(key);
    return value != nullptr && value->is_string() ? std::string{value->get_string()}
                                                  : std::string{};
}

bool flag(const json::object& object, const char* key) {
    const json::value* value = object.if_contains(key);
    return value != nullptr && value->is_bool() && value->get_bool();
}

void addOpened(std::vector<Finding>& findings, const json::object& opened) {
    findings.push_back({.group = "graphics",
                        .name = "OpenGL 4.5 core",
                        .ok = true,
                        .required = true,
                        .detail = text(opened, "gl_version") + ", " + text(opened, "gl_renderer") +
                                  ", on " + text(opened, "platform"),
                        .cost = {}});
    findings.push_back({.group = "graphics",
                        .name = "limits",
                        .ok = true,
                        .required = false,
                        .detail = "2D " + text(opened, "texture_side") + ", 3D " +
                                  text(opened, "texture_3d_side") + ", texel buffer " +
                                  text(opened, "texel_buffer_texels") + ", uniform block " +
                                  text(opened, "uniform_block_bytes") + ", storage block " +
                                  text(opened, "storage_block_bytes"),
                        .cost = {}});
    const bool robust = flag(opened, "robust");
    findings.push_back({.group = "graphics",
                        .name = "robust context",
                        .ok = robust,
                        .required = false,
                        .detail = robust ? "resets are reported" : "not granted",
                        .cost = "a GPU reset is noticed only by the frame deadline"});
    const bool software = flag(opened, "software");
    findings.push_back({.group = "graphics",
                        .name = "hardware rendering",
                        .ok = !software,
                        .required = false,
                        .detail = software ? "drawn by the CPU" : text(opened, "gl_renderer"),
                        .cost = "frames take ten to a hundred times longer; fine for small data"});
}

void addDevices(std::vector<Finding>& findings, const json::object& listing) {
    const json::value* devices = listing.if_contains("devices");
    if (devices == nullptr || !devices->is_array()) return;
    for (const json::value& entry : devices->get_array()) {
        if (!entry.is_object()) continue;
        const std::string gpu = text(entry.get_object(), "gpu");
        const std::string path = text(entry.get_object(), "path");
        const auto device = probe(gpu);
        const json::value* opened = device ? device->if_contains("opened") : nullptr;
        const bool ok = opened != nullptr && opened->is_object();
        const std::string reason = device ? text(*device, "error") : device.error().message;
        findings.push_back({.group = "graphics",
                            .name = "EGL device " + gpu,
                            .ok = ok,
                            .required = false,
                            .detail = (ok ? text(opened->get_object(), "gl_renderer") : reason) +
                                      (path.empty() ? "" : " (" + path + ")"),
                            .cost = "--gpu " + gpu + " cannot be used"});
    }
}

/// A small picture through the whole chain: import process, worker, shaders.
Finding drawOne(const std::string& gpu) {
    Finding finding{.group = "graphics",
                    .name = "drawing",
                    .ok = false,
                    .required = true,
                    .detail = {},
                    .cost = "there are no pictures"};
    const auto drawn = [&]() -> Result<double> {
        workers::ImportRequest demo;
        demo.path = "demo:mesh";
        auto data = workers::runImport(demo, {}, {});
        if (!data) return std::move(data).error();
        workers::RenderSettings settings;
        settings.gpu = gpu;
        settings.warmSpare = false;
        auto renderer = OfflineRenderer::create(settings);
        if (!renderer) return std::move(renderer).error();
        renderer->service().addDataset("demo", std::move(data->packed));
        workers::RenderRequest request;
        request.view = 1;
        request.size = {128, 128};
        request.scene = scene::defaultScene("demo", data->summary);
        auto frame = renderer->draw(request);
        if (!frame) return std::move(frame).error();
        return frame->uploadMs + frame->drawMs;
    }();
    finding.ok = drawn.has_value();
    finding.detail = drawn ? "the demo mesh, first frame " +
                                 std::to_string(static_cast<int>(*drawn)) +
                                 " ms with building shaders"
                           : drawn.error().message;
    return finding;
}

}  // namespace

std::vector<Finding> findGraphics(const std::string& gpu) {
    std::vector<Finding> findings;
    const auto listing = probe(gpu);
    if (!listing) {
        findings.push_back({.group = "graphics",
                            .name = "volcast-worker",
                            .ok = false,
                            .required = true,
                            .detail = listing.error().message,
                            .cost = "there are no pictures"});
        return findings;
    }
    const bool surfaceless = flag(*listing, "surfaceless");
    findings.push_back({.group = "graphics",
                        .name = "EGL platform surfaceless",
                        .ok = surfaceless,
                        .required = false,
                        .detail = surfaceless ? "EGL_MESA_platform_surfaceless" : "not offered",
                        .cost = "Mesa's software rendering needs an EGL device instead"});
    const bool devices = flag(*listing, "device_platform");
    findings.push_back({.group = "graphics",
                        .name = "EGL platform device",
                        .ok = devices,
                        .required = false,
                        .detail = devices ? "EGL_EXT_platform_device" : "not offered",
                        .cost = "a GPU cannot be chosen with --gpu"});
    addDevices(findings, *listing);
    const json::value* opened = listing->if_contains("opened");
    if (opened == nullptr || !opened->is_object()) {
        findings.push_back({.group = "graphics",
                            .name = "OpenGL 4.5 core",
                            .ok = false,
                            .required = true,
                            .detail = text(*listing, "error"),
                            .cost = "there are no pictures"});
        return findings;
    }
    addOpened(findings, opened->get_object());
    findings.push_back(drawOne(gpu));
    const std::string givenUp = workers::gpuGivenUp(userCacheFolder());
    findings.push_back({.group = "graphics",
                        .name = "GPU kept by the server",
                        .ok = givenUp.empty(),
                        .required = false,
                        .detail = givenUp.empty() ? "no GPU was given up" : givenUp,
                        .cost = "volcast serve draws by the CPU until it is started again"});
    return findings;
}

}  // namespace volcast::commands
