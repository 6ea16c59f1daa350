#include "renderer/mesh/shared.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/layer_draw.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/user_controls.h"
#include "renderer/shading/psi_table.h"

namespace volcast::scene {
namespace {

static_assert(kMaxOtherFields == mesh::shared::kMostOtherFields);

Result<void> preparePsiTable(DrawContext& context) {
    if (context.psiTable.valid()) return {};
    const std::vector<float> table = shading::makePsiTable();
    const auto bytes = std::as_bytes(std::span{table});
    auto made = gpu::Buffer::create(
        *context.device,
        {.bytes = bytes.size(), .texels = gpu::TexelFormat::kR32F, .label = "psi table"}, bytes);
    if (!made) return made.error();
    context.psiTable = std::move(*made);
    return {};
}

/// Brings the fields that code reads besides the layer's own.
Result<void> prepareOtherFields(DrawContext& context, LayerDraw& draw) {
    const data::DatasetSummary& summary = draw.dataset->summary();
    for (const int number : draw.code->otherChannels) {
        const FieldUse use = asStored(summary.fields[static_cast<std::size_t>(number)]);
        const auto field =
            draw.dataset->field(*context.device, *draw.layer, *draw.part, use, context.frame);
        if (!field) return field.error();
        draw.otherFields.push_back(*field);
    }
    return {};
}

}  // namespace

Result<void> prepareMesh(DrawContext& context, LayerDraw& draw) {
    const auto part = draw.dataset->part(*context.device, *draw.layer, context.frame);
    if (!part) return part.error();
    draw.part = *part;
    if (draw.plan->method == Integrator::kPsiTable) {
        if (auto made = preparePsiTable(context); !made) return made;
    }
    if (!needsField(*draw.layer)) return {};
    const FieldUse use = mainField(*draw.layer, draw.dataset->summary());
    const auto field =
        draw.dataset->field(*context.device, *draw.layer, **part, use, context.frame);
    if (!field) return field.error();
    draw.field = *field;
    if (draw.code) return prepareOtherFields(context, draw);
    const auto second = secondField(*draw.layer, draw.dataset->summary());
    if (!second) return {};
    const auto density =
        draw.dataset->field(*context.device, *draw.layer, **part, *second, context.frame);
    if (!density) return density.error();
    draw.density = *density;
    return {};
}

Result<void> drawMesh(const DrawContext& context, const Frame& frame, const LayerDraw& draw,
                      const gpu::Target& target) {
    if (draw.part->gpu == nullptr) return {};  // No cell is left to draw.
    mesh::UserInputs user;
    if (draw.code) {
        user = {.texts = draw.code->texts,
                .others = draw.otherFields,
                .iterations = draw.code->iterations};
    }
    const mesh::DrawInputs inputs{
        .device = context.device,
        .programs = context.programs,
        .mesh = &draw.part->mesh(std::get<data::Mesh>(draw.dataset->data())),
        .meshGpu = draw.part->gpu.get(),
        .field = draw.field,
        .density = draw.density,
        .layer = draw.layer,
        .plan = draw.plan,
        .camera = &frame.scene->camera,
        .planeDepth = frame.depths.nearest,
        .size = frame.size,
        .cameraVersion = frame.cameraVersion,
        .constants = draw.constants,
        .clipPlanes = static_cast<int>(frame.scene->clipPlanes.size()),
        .levels = draw.levels,
        .countsSteps = frame.countsSteps,
        .user = draw.code ? &user : nullptr,
        .psiTable = draw.plan->method == Integrator::kPsiTable ? &context.psiTable : nullptr,
        .target = &target};
    if (draw.plan->evaluator == plan::Evaluator::kMeshRaster) return mesh::drawSurface(inputs);
    return isProjected(draw) ? mesh::drawProjection(inputs, *draw.state->projection)
                             : mesh::drawWalk(inputs, *draw.state->walk);
}

}  // namespace volcast::scene
