#include "renderer/worker/pick_message.h"

#include <utility>

#include "renderer/worker/scene_message.h"

namespace volcast::worker {

internal::v1::Pick toMessage(const PickJob& job) {
    internal::v1::Pick message;
    *message.mutable_scene() = toMessage(job.scene);
    message.set_width(static_cast<std::uint32_t>(job.size.x));
    message.set_height(static_cast<std::uint32_t>(job.size.y));
    message.set_x(static_cast<std::uint32_t>(job.pixel.x));
    message.set_y(static_cast<std::uint32_t>(job.pixel.y));
    return message;
}

Result<PickJob> jobFrom(const internal::v1::Pick& message) {
    auto scene = sceneFrom(message.scene());
    if (!scene) return std::move(scene).error();
    return PickJob{.scene = *std::move(scene),
                   .size = {static_cast<int>(message.width()), static_cast<int>(message.height())},
                   .pixel = {static_cast<int>(message.x()), static_cast<int>(message.y())}};
}

v1::Picked toMessage(const std::optional<scene::Picked>& picked) {
    v1::Picked message;
    if (!picked) return message;
    message.set_layer(picked->layer);
    for (const scene::PickedValue& value : picked->values) {
        v1::PickedValue& added = *message.add_values();
        added.set_field(value.field);
        added.set_value(value.value);
    }
    message.mutable_position()->set_x(picked->position.x);
    message.mutable_position()->set_y(picked->position.y);
    message.mutable_position()->set_z(picked->position.z);
    message.set_distance(picked->distance);
    if (picked->cell) message.set_cell(*picked->cell);
    if (picked->voxel) {
        for (int i = 0; i < 3; ++i) {
            message.add_voxel(static_cast<std::uint32_t>((*picked->voxel)[i]));
        }
    }
    message.mutable_colour()->set_r(picked->colour.r);
    message.mutable_colour()->set_g(picked->colour.g);
    message.mutable_colour()->set_b(picked->colour.b);
    return message;
}

std::optional<scene::Picked> pickedFrom(const v1::Picked& message) {
    if (message.layer().empty()) return std::nullopt;
    scene::Picked picked{.layer = message.layer(), .values = {}};
    for (const v1::PickedValue& value : message.values()) {
        picked.values.push_back({.field = value.field(), .value = value.value()});
    }
    picked.position = {message.position().x(), message.position().y(), message.position().z()};
    picked.distance = message.distance();
    if (message.has_cell()) picked.cell = message.cell();
    if (message.voxel_size() == 3) {
        picked.voxel = glm::ivec3{message.voxel(0), message.voxel(1), message.voxel(2)};
    }
    picked.colour = {message.colour().r(), message.colour().g(), message.colour().b()};
    return picked;
}

}  // namespace volcast::worker
