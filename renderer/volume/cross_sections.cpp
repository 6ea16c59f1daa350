#include "renderer/plan/effects.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

Result<void> drawCrossSections(const DrawInputs& inputs) {
    std::vector<shading::Constant> constants = inputs.constants;
    constants.insert(constants.end(), {{"kSampling", static_cast<int>(inputs.layer->sampling)},
                                       {"kTexels", static_cast<int>(inputs.channel->texels())},
                                       {"kFilterInHardware", inputs.filterInHardware},
                                       {"kInterval", inputs.plan->has(plan::kInterval)},
                                       {"kClipPlanes", inputs.clipPlanes},
                                       {"kClipsAtStart", true}});
    const Result<const gpu::Program*> program =
        inputs.programs->ray({.evaluator = "volume/cross_sections.glsl",
                              .classify = "classify/transfer_function.glsl",
                              .segment = {},
                              .model = {},
                              .constants = std::move(constants)});
    if (!program) return program.error();
    inputs.target->begin({.depth = gpu::DepthTest::kNearest});
    (*program)->use();
    inputs.channel->bind();
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
    return {};
}

}  // namespace volcast::volume
