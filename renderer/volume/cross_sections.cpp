#include "renderer/volume/field.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

shading::Recipe crossSectionRecipe(const MarchTraits& traits,
                                   std::vector<shading::Constant> constants) {
    shading::Recipe recipe = marchRecipe(traits, std::move(constants));
    recipe.evaluator = "volume/cross_sections.glsl";
    return recipe;
}

Result<void> drawCrossSections(const DrawInputs& inputs) {
    const auto program =
        inputs.programs->ray(crossSectionRecipe(traitsOf(inputs), inputs.constants));
    if (!program) return program.error();
    inputs.target->begin({.depth = gpu::DepthTest::kNearest});
    (*program)->use();
    bindField(inputs);
    drawCover(inputs);
    return {};
}

}  // namespace volcast::volume
