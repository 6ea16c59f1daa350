#include "renderer/volume/slices.h"

#include <algorithm>
#include <cmath>

#include "renderer/drawing/combine_state.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/ray_models.h"

namespace volcast::volume {

namespace {

constexpr int kVerticesASlice = 12;  // A fan of four triangles.

glm::vec4 vector(const glm::dvec3& xyz, double w) {
    return {glm::vec3(xyz), w};
}

}  // namespace

Result<void> SlicesState::send(gpu::Device& device, const shading::shared::SliceBlock& block) {
    if (!block_.valid()) {
        auto made = gpu::Buffer::create(
            device, {.bytes = sizeof(block), .updatable = true, .label = "planes of slices"});
        if (!made) return made.error();
        block_ = std::move(*made);
    }
    block_.update(0, std::as_bytes(std::span{&block, 1}));
    return {};
}

SlicePlanes slicePlanes(const data::Volume& volume, const scene::Camera& camera, double start,
                        double step) {
    const glm::dvec3 forward = scene::frame(camera).forward;
    glm::dvec3 corner{0.0};
    double depth = 0.0;
    SlicePlanes planes;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 edge = volume.direction[axis] * (volume.spacing[axis] * (volume.size[axis] - 1));
        const double rise = glm::dot(edge, forward);
        if (rise < 0.0) {
            corner += edge;
            edge = -edge;
        }
        depth += std::abs(rise);
        planes.block.edges[axis] = vector(edge, std::abs(rise));
    }
    const double nearest = glm::dot(volume.origin + corner - camera.eye, forward);
    const double begin = std::max(nearest, start);
    const double end = nearest + depth;
    if (!(begin < end)) return planes;
    const double count =
        std::clamp(std::ceil((end - begin) / step), 1.0, static_cast<double>(plan::kMaxRaySamples));
    const double apart = (end - begin) / count;
    planes.count = static_cast<int>(count);
    planes.block.corner = vector(corner, 0.0);
    planes.block.planes = {begin - start + 0.5 * apart, apart, nearest - start, 0.0F};
    return planes;
}

shading::Recipe sliceRecipe(const MarchTraits& traits, bool instances,
                            std::vector<shading::Constant> constants) {
    shading::Recipe recipe = marchRecipe(traits, std::move(constants));
    recipe.evaluator = "volume/slices.glsl";
    recipe.constants.push_back({"kInstances", instances});
    return recipe;
}

Result<void> drawSlices(const DrawInputs& inputs, const data::Volume& volume,
                        const scene::Camera& camera, double start, glm::ivec2 size,
                        SlicesState& state) {
    const bool instances = inputs.plan->evaluator == plan::Evaluator::kVolumeSliceInstances;
    const shading::Recipe recipe = sliceRecipe(traitsOf(inputs), instances, inputs.constants);
    const auto program = inputs.programs->ray(recipe, kSliceVertex);
    if (!program) return program.error();
    shading::Recipe finishRecipe = recipe;
    finishRecipe.evaluator = "lib/finish_shares.glsl";
    const auto finish = inputs.programs->ray(finishRecipe);
    if (!finish) return finish.error();
    const SlicePlanes planes = slicePlanes(volume, camera, start, inputs.plan->stepWorld);
    if (planes.count == 0) return {};
    Result<void> made = state.fit(*inputs.device, size);
    if (made) made = state.send(*inputs.device, planes.block);
    if (!made) return made;

    const drawing::CombineState& combine =
        drawing::stateOf(scene::row(inputs.layer->model).combine);
    state.target().begin({.blend = combine.blend});
    state.target().clearColour(0, glm::vec4{combine.neutral});
    (*program)->use();
    inputs.channel->bind();
    state.bindBlock();
    if (instances) {
        inputs.device->draw(gpu::Primitive::kTriangles, kVerticesASlice, planes.count);
    } else {
        inputs.device->draw(gpu::Primitive::kTriangles, kVerticesASlice * planes.count);
    }
    inputs.target->begin({.blend = gpu::Blend::kOver});
    (*finish)->use();
    state.bindShares();
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
    return {};
}

}  // namespace volcast::volume
