#include "server/commands/render_scene.h"

#include <cmath>
#include <string>
#include <utility>

#include <boost/json.hpp>

#include "renderer/scene/default_scene.h"
#include "renderer/scene/validate.h"
#include "renderer/worker/scene_json.h"
#include "server/commands/camera_file.h"
#include "server/commands/files.h"
#include "server/commands/option_layer.h"

namespace volcast::commands {

namespace {

/// A scene file but for "editor", what the web client knows besides of how its maps were edited.
std::string withoutEditor(const std::string& text) {
    boost::system::error_code failed;
    boost::json::value file = boost::json::parse(text, failed);
    if (failed || !file.is_object() || file.as_object().erase("editor") == 0) return text;
    return boost::json::serialize(file);
}

Result<scene::Scene> documentScene(const SceneOptions& options,
                                   const data::DatasetSummary& summary) {
    auto text = readTextFile(options.sceneFile);
    if (!text) return std::move(text).error();
    auto scene = worker::sceneFromJson(withoutEditor(*text), [&](const std::string& field) {
        return scene::defaultLayer(kRenderDataset, summary, field, scene::RayModel::kVolume);
    });
    if (!scene) return in(options.sceneFile, scene.error());
    return scene;
}

Result<scene::Camera> cameraFor(const SceneOptions& options, const scene::Camera& usual) {
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

Result<scene::Scene> sceneFor(const SceneOptions& options, const data::DatasetSummary& summary) {
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
        const std::vector<float>& rgb = options.background;
        scene.background = {rgb[0], rgb[1], rgb[2], 1.0F};
    }
    for (const auto& [x, y, z, offset] : options.clip) {
        scene.clipPlanes.push_back({.normal = {x, y, z}, .offset = offset});
    }
    if (!options.accuracy.empty()) scene.accuracy = *parseAccuracy(options.accuracy);
    if (auto valid = scene::validate(scene); !valid) return std::move(valid).error();
    if (auto valid = scene::validate(scene, {{kRenderDataset, summary}}); !valid) {
        return in(options.dataset, valid.error());
    }
    return scene;
}

}  // namespace volcast::commands
