#include "server/commands/render_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/scene/default_scene.h"
#include "renderer/scene/validate.h"
#include "renderer/worker/scene_json.h"
#include "server/commands/camera_file.h"
#include "server/commands/files.h"

namespace volcast::commands {

namespace {

/// `error` of something read from `path`.
Error in(const std::string& path, const Error& error) {
    const bool named = error.field.empty() || error.message.find(error.field) != std::string::npos;
    return fail(error.code, path + ": " + (named ? "" : error.field + ": ") + error.message,
                error.field);
}

scene::RayModel modelFrom(const std::string& name) {
    if (name == "surface") return scene::RayModel::kSurface;
    if (name == "mip" || name == "max") return scene::RayModel::kMip;
    return scene::RayModel::kVolume;
}

Result<std::string> chosenField(const RenderOptions& options, const data::DatasetSummary& summary) {
    std::string names;
    for (const data::FieldSummary& field : summary.fields) {
        if (field.name == options.field) return field.name;
        names += (names.empty() ? "" : ", ") + field.name;
    }
    if (!options.field.empty()) {
        return fail(ErrorCode::kNotFound,
                    options.dataset + ": has no field \"" + options.field + "\"" +
                        (names.empty() ? "; it has none" : "; it has " + names));
    }
    return summary.fields.empty() ? std::string{} : summary.fields.front().name;
}

glm::vec3 vectorFrom(const std::vector<float>& values) {
    return {values[0], values[1], values[2]};
}

/// The one layer of a scene without a document.
Result<scene::Layer> layerFor(const RenderOptions& options, const data::DatasetSummary& summary,
                              scene::RayModel usual) {
    auto field = chosenField(options, summary);
    if (!field) return std::move(field).error();
    const scene::RayModel model = options.model.empty() ? usual : modelFrom(options.model);
    scene::Layer layer = scene::defaultLayer(kRenderDataset, summary, *field, model);
    if (!options.map.empty()) {
        auto text = readTextFile(options.map);
        if (!text) return std::move(text).error();
        auto map = data::parseTransferFunction(*text);
        if (!map) return in(options.map, map.error());
        layer.map = *std::move(map);
    }
    layer.timeStep = options.timeStep;
    layer.stepWorld = options.step;
    layer.headlight = !options.unlit;
    if (options.coloured) layer.coloured = true;
    if (!options.colour.empty()) {
        layer.coloured = false;
        layer.surfaceColour = vectorFrom(options.colour);
    }
    if (options.sampling == "nearest") layer.sampling = scene::Sampling::kNearest;
    if (options.integrator == "average") layer.integrator = scene::Integrator::kAverage;
    return layer;
}

Result<scene::Scene> documentScene(const RenderOptions& options,
                                   const data::DatasetSummary& summary) {
    auto text = readTextFile(options.sceneFile);
    if (!text) return std::move(text).error();
    auto scene = worker::sceneFromJson(*text, [&](const std::string& field) {
        return scene::defaultLayer(kRenderDataset, summary, field, scene::RayModel::kVolume);
    });
    if (!scene) return in(options.sceneFile, scene.error());
    return scene;
}

Result<scene::Camera> cameraFor(const RenderOptions& options, const scene::Camera& usual) {
    scene::Camera camera = usual;
    if (!options.camera.empty()) {
        auto text = readTextFile(options.camera);
        if (!text) return std::move(text).error();
        auto read = parseCamera(*text);
        if (!read) return in(options.camera, read.error());
        camera = *read;
    }
    if (options.projection == "orthographic" &&
        camera.projection != scene::Projection::kOrthographic) {
        camera.projection = scene::Projection::kOrthographic;
        camera.orthographicHeight = 2.0 * glm::length(camera.eye - camera.center) *
                                    std::tan(glm::radians(camera.fovyDegrees) / 2.0);
    } else if (options.projection == "perspective") {
        camera.projection = scene::Projection::kPerspective;
    }
    return camera;
}

}  // namespace

Result<scene::Scene> sceneFor(const RenderOptions& options, const data::DatasetSummary& summary) {
    scene::Scene scene = scene::defaultScene(kRenderDataset, summary);
    if (!options.sceneFile.empty()) {
        auto document = documentScene(options, summary);
        if (!document) return document;
        scene = *std::move(document);
    } else {
        auto layer = layerFor(options, summary, scene.layers.front().model);
        if (!layer) return std::move(layer).error();
        scene.layers = {*std::move(layer)};
        scene.background.a = 0.0F;
    }
    auto camera = cameraFor(options, scene.camera);
    if (!camera) return std::move(camera).error();
    scene.camera = *camera;
    if (!options.background.empty()) {
        scene.background = glm::vec4(vectorFrom(options.background), 1.0F);
    }
    if (auto valid = scene::validate(scene); !valid) return std::move(valid).error();
    if (auto valid = scene::validate(scene, {{kRenderDataset, summary}}); !valid) {
        return in(options.dataset, valid.error());
    }
    return scene;
}

}  // namespace volcast::commands
