#include "renderer/mesh/projection.h"

#include <algorithm>

#include "renderer/drawing/combine_state.h"
#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/projection_cache.h"
#include "renderer/mesh/shared.h"
#include "renderer/plan/effects.h"
#include "renderer/shading/psi_table.h"
#include "renderer/shading/shared.h"

namespace volcast::mesh {

namespace {

constexpr int kVerticesACell = 12;
constexpr int kVerticesALevelCell = 6;
constexpr int kCellsAnInstance = 4096;  // An instance costs llvmpipe a quarter of a microsecond.

ProjectionTraits traitsOf(const DrawInputs& inputs) {
    const bool perspective = inputs.camera->projection == scene::Projection::kPerspective;
    const bool clipsAtStart = inputs.planeDepth <= 0.0;
    ProjectionTraits traits{.model = inputs.layer->model,
                            .integrator = inputs.plan->method,
                            .valuesAt = valuesAt(inputs.field),
                            .densityAt = valuesAt(inputs.density),
                            .interval = inputs.plan->has(plan::kInterval),
                            .clipPlanes = inputs.clipPlanes,
                            .clipsAtStart = clipsAtStart,
                            .sides = clipsAtStart && perspective ? Sides::kFar : Sides::kNear};
    // Where rays are cut within a cell they end at values that no face has.
    const bool cut = clipsAtStart || traits.interval || traits.clipPlanes > 0 ||
                     inputs.plan->has(plan::kEndsAtSurfaces);
    if (inputs.plan->evaluator == plan::Evaluator::kMeshProjectionFaces && !cut) {
        traits.sides = Sides::kAll;
    }
    return traits;
}

void drawEach(const DrawInputs& inputs, int count, int vertices) {
    if (count == 0) return;
    inputs.device->draw(gpu::Primitive::kTriangles, vertices * std::min(count, kCellsAnInstance),
                        (count + kCellsAnInstance - 1) / kCellsAnInstance);
}

/// Draws the cells into the blended shares.
void drawCells(const DrawInputs& inputs, const gpu::Program& program,
               const drawing::CombineState& combine, const ProjectionCache& cache) {
    cache.shares().begin({.blend = combine.blend, .depth = combine.depth});
    cache.shares().clearColour(0, glm::vec4{combine.neutral});
    program.use();
    cache.bind(inputs);
    if (inputs.psiTable != nullptr) inputs.psiTable->bindTexels(shading::shared::kPsiTableUnit);
    drawEach(inputs, MeshBuffers::of(*inputs.meshGpu).cellCount, kVerticesACell);
}

/// Draws what levels cut out of cells into the picture.
Result<void> drawLevels(const DrawInputs& inputs, const drawing::CombineState& combine,
                        ProjectionCache& cache) {
    const LevelTraits traits{.valuesAt = valuesAt(inputs.field),
                             .densityAt = valuesAt(inputs.density),
                             .lit = inputs.plan->has(plan::kGradient),
                             .clipPlanes = inputs.clipPlanes,
                             .clipsAtStart = inputs.planeDepth <= 0.0};
    const auto program = inputs.programs->ray(levelRecipe(traits, inputs.constants), kLevelVertex);
    if (!program) return program.error();
    if (auto done = cache.prepareLevels(inputs); !done) return done;
    inputs.target->begin({.blend = combine.blend, .depth = combine.depth});
    (*program)->use();
    cache.bind(inputs);
    cache.levels().bind();
    drawEach(inputs, cache.levels().count(), kVerticesALevelCell);
    return {};
}

}  // namespace

shading::Recipe projectionRecipe(const ProjectionTraits& traits,
                                 std::vector<shading::Constant> constants) {
    const scene::RayModelRow& row = scene::row(traits.model);
    const scene::IntegratorRow* integrator = scene::integratorRow(traits.model, traits.integrator);
    constants.insert(constants.end(), {{"kValuesAt", traits.valuesAt},
                                       {"kDensityAt", traits.densityAt},
                                       {"kInterval", traits.interval},
                                       {"kClipPlanes", traits.clipPlanes},
                                       {"kClipsAtStart", traits.clipsAtStart},
                                       {"kSorted", drawing::stateOf(row.combine).sorted},
                                       {"kSides", static_cast<int>(traits.sides)},
                                       {"kPsiTableSide", shading::kPsiTableSide},
                                       {"kCellsAnInstance", kCellsAnInstance}});
    return {.evaluator =
                traits.sides == Sides::kAll ? "mesh/projection_faces.glsl" : "mesh/projection.glsl",
            .classify = "classify/transfer_function.glsl",
            .segment = integrator == nullptr ? "" : std::string{integrator->chunk},
            .model = std::string{row.chunk},
            .constants = std::move(constants)};
}

shading::Recipe projectionFinishRecipe(const ProjectionTraits& traits,
                                       std::vector<shading::Constant> constants) {
    shading::Recipe recipe = projectionRecipe(traits, {});
    recipe.evaluator = "lib/finish_shares.glsl";
    constants.push_back({"kPsiTableSide", shading::kPsiTableSide});
    recipe.constants = std::move(constants);
    return recipe;
}

shading::Recipe levelRecipe(const LevelTraits& traits, std::vector<shading::Constant> constants) {
    constants.insert(constants.end(), {{"kValuesAt", traits.valuesAt},
                                       {"kDensityAt", traits.densityAt},
                                       {"kLit", traits.lit},
                                       {"kClipPlanes", traits.clipPlanes},
                                       {"kClipsAtStart", traits.clipsAtStart},
                                       {"kCellsAnInstance", kCellsAnInstance}});
    return {.evaluator = "mesh/level_polygons.glsl",
            .classify = "classify/transfer_function.glsl",
            .segment = "",
            .model = "",
            .constants = std::move(constants)};
}

std::unique_ptr<ProjectionState> ProjectionState::create() {
    return std::make_unique<ProjectionCache>();
}

Result<void> drawProjection(const DrawInputs& inputs, ProjectionState& state) {
    ProjectionCache& cache = ProjectionCache::of(state);
    const drawing::CombineState& combine =
        drawing::stateOf(scene::row(inputs.layer->model).combine);
    if (combine.combine == scene::Combine::kNearest) return drawLevels(inputs, combine, cache);
    const ProjectionTraits traits = traitsOf(inputs);
    const auto cells =
        inputs.programs->ray(projectionRecipe(traits, inputs.constants), kProjectionVertex);
    if (!cells) return cells.error();
    if (auto done = cache.prepare(inputs, combine.sorted); !done) return done;
    drawCells(inputs, **cells, combine, cache);
    const auto finish = inputs.programs->ray(projectionFinishRecipe(traits, inputs.constants));
    if (!finish) return finish.error();
    inputs.target->begin({.blend = gpu::Blend::kOver});
    (*finish)->use();
    cache.bindShares();
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
    return {};
}

}  // namespace volcast::mesh
