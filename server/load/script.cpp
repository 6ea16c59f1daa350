#include "server/load/script.h"

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace volcast::load {

namespace {

constexpr double kStepRadians = 2.0 * std::numbers::pi / 120.0;  ///< 120 inputs a turn.
constexpr std::uint64_t kInputsPerModel = 10;

glm::dvec3 vec(const v1::Vec3& message) {
    return {message.x(), message.y(), message.z()};
}

}  // namespace

const char* name(Kind kind) noexcept {
    switch (kind) {
        case Kind::kOrbit: return "orbit";
        case Kind::kMap: return "map";
        case Kind::kModel: return "model";
        case Kind::kJoin: return "join";
        case Kind::kIdle: return "idle";
        case Kind::kSlow: return "slow";
        case Kind::kShaped: return "shaped";
    }
    return "";
}

std::optional<Kind> kindFrom(const std::string& text) {
    for (const Kind kind : kKinds) {
        if (text == name(kind)) return kind;
    }
    return std::nullopt;
}

bool moves(Kind kind) noexcept {
    return kind != Kind::kJoin && kind != Kind::kIdle;
}

void Script::next(v1::Update& update) {
    ++step_;
    switch (kind_) {
        case Kind::kMap: *update.mutable_scene() = withMap(); break;
        case Kind::kModel: *update.mutable_scene() = withModel(); break;
        default: *update.mutable_camera() = turned();
    }
}

v1::Camera Script::turned() const {
    v1::Camera camera = scene_.camera();
    const glm::dvec3 center = vec(camera.center());
    const double angle = kStepRadians * static_cast<double>(step_);
    const glm::dmat4 turn = glm::rotate(glm::dmat4{1.0}, angle, vec(camera.up()));
    const glm::dvec3 eye = center + glm::dvec3{turn * glm::dvec4{vec(camera.eye()) - center, 0.0}};
    camera.mutable_eye()->set_x(eye.x);
    camera.mutable_eye()->set_y(eye.y);
    camera.mutable_eye()->set_z(eye.z);
    return camera;
}

/// Extinction swings around what it was, the colours' red with it.
v1::Scene Script::withMap() const {
    v1::Scene scene = scene_;
    const double swing = std::sin(kStepRadians * static_cast<double>(step_));
    for (v1::Layer& layer : *scene.mutable_layers()) {
        for (v1::ControlPoint& point : *layer.mutable_transfer_function()->mutable_points()) {
            point.set_extinction(point.extinction() * (1.0 + 0.8 * swing));
            point.mutable_colour()->set_r(static_cast<float>(0.5 + 0.5 * swing));
        }
    }
    return scene;
}

/// One model after the other, turning, as equal scenes would not be drawn again; isosurfaces at
/// three values of the map.
v1::Scene Script::withModel() const {
    v1::Scene scene = scene_;
    *scene.mutable_camera() = turned();
    if (models_.empty()) return scene;
    const v1::RayModel model = models_[(step_ / kInputsPerModel) % models_.size()];
    for (v1::Layer& layer : *scene.mutable_layers()) {
        layer.set_model(model);
        layer.set_integrator(v1::INTEGRATOR_AUTO);
        layer.set_evaluator(v1::MESH_EVALUATOR_AUTO);
        layer.set_voxel_evaluator(v1::VOXEL_EVALUATOR_AUTO);
        const auto& points = layer.transfer_function().points();
        if (model != v1::RAY_MODEL_ISOSURFACE || points.empty()) continue;
        const double first = points[0].value();
        const double last = points[points.size() - 1].value();
        layer.mutable_levels()->Clear();
        for (const double part : {0.25, 0.5, 0.75}) {
            layer.mutable_levels()->add_values(first + part * (last - first));
        }
    }
    return scene;
}

}  // namespace volcast::load
