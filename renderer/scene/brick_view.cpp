#include "renderer/scene/brick_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/plan/effects.h"
#include "renderer/scene/layer_block.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/shown_values.h"

namespace volcast::scene {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// dot(axis, world position - from) as a function of grid coordinates.
glm::dvec4 inGrid(const data::Volume& volume, const glm::dvec3& axis, const glm::dvec3& from) {
    return {glm::transpose(volume.direction) * axis * volume.spacing,
            glm::dot(axis, volume.origin - from)};
}

/// The four sides of what a picture shows, and the plane of the eye.
std::vector<glm::dvec4> sidesOf(const volume::BrickView& view, const glm::dvec2& half) {
    std::vector<glm::dvec4> sides{view.depth};
    for (const double sign : {-1.0, 1.0}) {
        // At the picture's edge, right = half * depth, or half where rays are parallel.
        const auto side = [&](const glm::dvec4& axis, double extent) {
            return view.perspective ? extent * view.depth + sign * axis
                                    : sign * axis + glm::dvec4(0.0, 0.0, 0.0, extent);
        };
        sides.push_back(side(view.right, half.x));
        sides.push_back(side(view.up, half.y));
    }
    return sides;
}

/// Whether values of a range can show; empty where all do.
std::function<bool(glm::vec2)> showsOf(const Layer& layer, const plan::LayerPlan& plan,
                                       const data::DatasetSummary& summary) {
    volume::ShownValues shown = shownValues(layer, plan, summary);
    if (shown == kAllValues) return {};
    const ScaleFunction scale{layer.scale, findField(summary, layer.field)->range};
    return [scale, shown = std::move(shown)](glm::vec2 range) {
        return volume::shows(shown, {scale.ofPoint(range.x), scale.ofPoint(range.y)});
    };
}

}  // namespace

volume::BrickView brickView(const Scene& scene, PictureSize size, const Layer& layer,
                            const plan::LayerPlan& plan, const data::Volume& volume,
                            const data::DatasetSummary& summary) {
    const Camera& camera = scene.camera;
    const CameraFrame axes = frame(camera);
    volume::BrickView view;
    view.depth = inGrid(volume, axes.forward, camera.eye);
    view.right = inGrid(volume, axes.right, camera.eye);
    view.up = inGrid(volume, axes.up, camera.eye);
    view.perspective = camera.projection == Projection::kPerspective;
    const double half = view.perspective ? std::tan(0.5 * camera.fovyDegrees * kPi / 180.0)
                                         : 0.5 * camera.orthographicHeight;
    view.planes = sidesOf(view, {half * size.x / size.y, half});
    for (const ClipPlane& plane : scene.clipPlanes) {
        const double length = glm::length(plane.normal);
        glm::dvec4 kept = inGrid(volume, plane.normal / length, glm::dvec3{0.0});
        kept.w -= plane.offset / length;
        view.planes.push_back(kept);
    }
    if (layer.model == RayModel::kCrossSections) {
        // As the shader has them, or a plane could lie on the other side of a face.
        view.sections = glm::dvec3(glm::vec3(meetingPoint(layer.crossSections, volume)));
        for (int axis = 0; axis < 3; ++axis) {
            if (layer.crossSections.shown[axis]) continue;
            (*view.sections)[axis] = std::numeric_limits<double>::quiet_NaN();
        }
    }
    view.footprint = 2.0 * half / size.y;
    view.stepWorld = plan.stepWorld;
    view.voxelWorld = std::max({volume.spacing.x, volume.spacing.y, volume.spacing.z});
    view.reachesAround = layer.sampling == Sampling::kTricubic;
    view.overshoot = view.reachesAround ? plan::kTricubicOvershoot : 0.0;
    view.shows = showsOf(layer, plan, summary);
    return view;
}

}  // namespace volcast::scene
