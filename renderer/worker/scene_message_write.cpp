// Scenes as messages; scene_message.cpp reads them.
#include "renderer/worker/scene_message.h"
#include "renderer/worker/scene_message_pairs.h"
#include "renderer/worker/user_shader_message.h"

namespace volcast::worker {

namespace {

void put(v1::Vec3* message, const glm::dvec3& value) {
    message->set_x(value.x);
    message->set_y(value.y);
    message->set_z(value.z);
}

void put(v1::Colour* message, const glm::vec3& value) {
    message->set_r(value.r);
    message->set_g(value.g);
    message->set_b(value.b);
}

void put(v1::Camera* message, const scene::Camera& camera) {
    put(message->mutable_eye(), camera.eye);
    put(message->mutable_center(), camera.center);
    put(message->mutable_up(), camera.up);
    message->set_projection(camera.projection == scene::Projection::kOrthographic
                                ? v1::PROJECTION_ORTHOGRAPHIC
                                : v1::PROJECTION_PERSPECTIVE);
    message->set_fovy_degrees(camera.fovyDegrees);
    message->set_orthographic_height(camera.orthographicHeight);
}

void put(v1::TransferFunction* message, const data::TransferFunction& map) {
    for (const data::ControlPoint& point : map.points) {
        v1::ControlPoint* added = message->add_points();
        added->set_value(point.value);
        put(added->mutable_colour(), point.colour);
        added->set_extinction(point.extinction);
    }
}

void put(v1::Range* message, const data::Range& range) {
    message->set_min(range.min);
    message->set_max(range.max);
}

void put(v1::Scale* message, const scene::Scale& scale) {
    message->set_kind(theirsFrom(kScales, scale.kind));
    message->set_exponent(scale.exponent);
    if (scale.domain) put(message->mutable_domain(), *scale.domain);
}

/// What stands at its default is left out.
void putSelection(v1::Layer* message, const scene::Layer& layer) {
    if (layer.scale != scene::Scale{}) put(message->mutable_scale(), layer.scale);
    message->set_density_field(layer.densityField);
    if (!layer.densityMap.points.empty()) {
        put(message->mutable_density_function(), layer.densityMap);
    }
    if (layer.densityScale != scene::Scale{}) {
        put(message->mutable_density_scale(), layer.densityScale);
    }
    if (layer.interval) put(message->mutable_interval(), *layer.interval);
    if (layer.markers == scene::CellMarkers{}) return;
    message->mutable_markers()->set_field(layer.markers.field);
    for (const float value : layer.markers.values) message->mutable_markers()->add_values(value);
}

void put(v1::Light* message, const scene::Light& light) {
    if (light.position) put(message->mutable_position(), *light.position);
    message->set_ambient(light.ambient);
    message->set_diffuse(light.diffuse);
    message->set_specular(light.specular);
    message->set_exponent(light.exponent);
}

void put(v1::CrossSections* message, const scene::CrossSections& sections) {
    if (sections.point) put(message->mutable_point(), *sections.point);
    message->set_hide_first(!sections.shown.x);
    message->set_hide_second(!sections.shown.y);
    message->set_hide_third(!sections.shown.z);
}

void putVoxels(v1::Layer* message, const scene::Layer& layer) {
    message->set_voxel_evaluator(theirsFrom(kVoxelEvaluators, layer.voxelEvaluator));
    message->set_depth_samples(layer.depthSamples);
    message->set_gain(layer.gain);
    if (layer.jitter) message->set_jitter(*layer.jitter);
    for (const scene::ChannelMap& channel : layer.channels) {
        v1::ChannelMap* added = message->add_channels();
        added->set_field(channel.field);
        put(added->mutable_transfer_function(), channel.map);
        added->set_hidden(!channel.visible);
        if (channel.interval) put(added->mutable_interval(), *channel.interval);
    }
    if (layer.shader != scene::UserShader{}) *message->mutable_shader() = toMessage(layer.shader);
    if (layer.crossSections != scene::CrossSections{}) {
        put(message->mutable_cross_sections(), layer.crossSections);
    }
}

void putParameters(v1::Layer* message, const scene::Layer& layer) {
    message->set_edge_width(layer.edgeWidth);
    put(message->mutable_edge_colour(), layer.edgeColour);
    message->set_extinction_scale(layer.extinctionScale);
    message->set_exposure(layer.exposure);
    if (layer.light) put(message->mutable_light(), *layer.light);
    putVoxels(message, layer);
    if (layer.levels == scene::Levels{}) return;
    v1::Levels* levels = message->mutable_levels();
    levels->set_spacing(theirsFrom(kSpacings, layer.levels.spacing));
    for (const float value : layer.levels.values) levels->add_values(value);
    levels->set_first(layer.levels.first);
    levels->set_last(layer.levels.last);
    levels->set_count(layer.levels.count);
    levels->set_exponent(layer.levels.exponent);
}

void put(v1::Layer* message, const scene::Layer& layer) {
    message->set_id(layer.id);
    message->set_dataset(layer.dataset);
    message->set_field(layer.field);
    message->set_time_step(layer.timeStep);
    message->set_model(theirsFrom(kModels, layer.model));
    put(message->mutable_transfer_function(), layer.map);
    message->set_hidden(!layer.visible);
    message->set_coloured(layer.coloured);
    put(message->mutable_surface_colour(), layer.surfaceColour);
    message->set_unlit(!layer.headlight);
    message->set_integrator(theirsFrom(kIntegrators, layer.integrator));
    message->set_evaluator(theirsFrom(kEvaluators, layer.evaluator));
    putSelection(message, layer);
    putParameters(message, layer);
    message->set_step_world(layer.stepWorld);
    message->set_sampling(theirsFrom(kSamplings, layer.sampling));
}

}  // namespace

v1::Scene toMessage(const scene::Scene& scene) {
    v1::Scene message;
    put(message.mutable_camera(), scene.camera);
    for (const scene::Layer& layer : scene.layers) put(message.add_layers(), layer);
    put(message.mutable_background(), glm::vec3(scene.background));
    message.set_background_transparency(1.0 - static_cast<double>(scene.background.a));
    for (const scene::ClipPlane& plane : scene.clipPlanes) {
        v1::ClipPlane* added = message.add_clip_planes();
        put(added->mutable_normal(), plane.normal);
        added->set_offset(plane.offset);
    }
    if (scene.accuracy != scene::Accuracy{}) {
        message.mutable_accuracy()->set_kind(theirsFrom(kAccuracies, scene.accuracy.kind));
        message.mutable_accuracy()->set_bound(scene.accuracy.bound);
    }
    return message;
}

v1::RayModel toMessage(scene::RayModel model) {
    return theirsFrom(kModels, model);
}

v1::Integrator toMessage(scene::Integrator integrator) {
    return theirsFrom(kIntegrators, integrator);
}

v1::MeshEvaluator toMessage(scene::MeshEvaluator evaluator) {
    return theirsFrom(kEvaluators, evaluator);
}

}  // namespace volcast::worker
