#include "renderer/data/load/surface_files.h"

#include <utility>

#include "renderer/data/load/file.h"
#include "renderer/data/load/formats.h"

namespace volcast::data::load {

namespace {

Result<Surface> parse(const Request& request, std::string_view text,
                      std::vector<std::string>& warnings) {
    const std::string_view suffix = formatOf(request.path)->suffix;
    if (suffix == ".off") return parseOff(request.path, text);
    if (suffix == ".stl") return parseStl(request.path, text);
    if (suffix == ".ply") return parsePly(request.path, text, warnings);
    const std::string nodePath = withSuffix(request.path, ".node");
    if (!exists(nodePath)) return parsePoly(request.path, text, {});
    const auto nodes = readFile(nodePath, request.maxMemoryBytes);
    if (!nodes) return nodes.error();
    return parsePoly(request.path, text, *nodes);
}

}  // namespace

Result<Loaded> readSurface(const Request& request, const Progress& progress) {
    const auto text = readFile(request.path, request.maxMemoryBytes);
    if (!text) return text.error();
    Loaded loaded{.format = std::string{formatOf(request.path)->name} + " surface"};
    const auto surface = parse(request, *text, loaded.warnings);
    if (!surface) return surface.error();
    progress("mesh", 0.0);
    auto made = tetrahedralize(*surface, request.tetgenSwitches);
    if (!made) return fail(made.error().code, request.path + ": " + made.error().message);
    if (made->addedPoints > 0 && !surface->attributes.empty()) {
        loaded.warnings.push_back("attributes of points are left out: the mesh has " +
                                  std::to_string(made->addedPoints) + " points without them");
    }
    loaded.input = std::move(made->mesh);
    return loaded;
}

}  // namespace volcast::data::load
