#include "tests/support/numerics/segments_probe.h"

#include <array>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/scene/map_table.h"
#include "renderer/shading/shared.h"
#include "tests/support/numerics/weights_probe.h"

namespace volcast::support {
namespace {

Result<gpu::Buffer> texels(gpu::Device& device, const std::vector<glm::vec4>& values) {
    return gpu::Buffer::create(device,
                               {.bytes = values.size() * sizeof(glm::vec4),
                                .texels = gpu::TexelFormat::kRgba32F,
                                .label = "segments"},
                               std::as_bytes(std::span{values}));
}

std::string chunk(const std::string& folder, const std::string& name) {
    return name.empty() ? "" : folder + "/" + name + ".glsl";
}

}  // namespace

SegmentsProbe::SegmentsProbe(gpu::Device& device)
    : device_{&device}, programs_{device, chunksWithProbes()} {}

Result<std::vector<ProbedAnswer>> SegmentsProbe::operator()(const ProbedModel& chunks,
                                                            const scene::MapContent& content,
                                                            std::span<const ProbedRay> rays) {
    scene::MapTable table;
    if (auto set = table.set(*device_, content); !set) return set.error();
    auto constants = table.constants();
    constants.push_back({"kLit", false});
    const auto program = programs_.ray({.evaluator = "segments.glsl",
                                        .classify = "classify/transfer_function.glsl",
                                        .segment = chunk("segment", chunks.segment),
                                        .model = chunk("model", chunks.model),
                                        .constants = std::move(constants)});
    if (!program) return program.error();

    std::vector<glm::vec4> lists, segments;  // As segments.glsl reads them.
    for (const ProbedRay& ray : rays) {
        lists.emplace_back(segments.size() / 2, ray.size(), 0.0F, 0.0F);
        for (const ProbedSegment& s : ray) {
            segments.emplace_back(s.front, s.back, s.extent, 0.0F);
            segments.emplace_back(s.goesOn ? 0.0F : 1.0F, 0.0F, 0.0F, 0.0F);
        }
    }
    const auto listTexels = texels(*device_, lists);
    if (!listTexels) return listTexels.error();
    const auto segmentTexels = texels(*device_, segments);
    if (!segmentTexels) return segmentTexels.error();
    shading::shared::LayerBlock layer{};
    layer.gather = {1.0F, 1.0F, -3.4e38F, 3.4e38F};
    const auto block = gpu::Buffer::create(*device_, {.bytes = sizeof layer, .label = "layer"},
                                           std::as_bytes(std::span{&layer, 1}));
    if (!block) return block.error();
    const glm::ivec2 size{static_cast<int>(rays.size()), 1};
    const auto answer = gpu::Texture2D::create(*device_, {.size = size, .label = "answer"});
    if (!answer) return answer.error();
    const auto detail = gpu::Texture2D::create(*device_, {.size = size, .label = "detail"});
    if (!detail) return detail.error();
    const std::array colours{&*answer, &*detail};
    const auto target = gpu::Target::create(*device_, "segments", colours);
    if (!target) return target.error();

    target->begin({});
    (*program)->use();
    table.bind();
    block->bindUniform(shading::shared::kLayerBinding);
    listTexels->bindTexels(5);
    segmentTexels->bindTexels(6);
    device_->draw(gpu::Primitive::kTriangles, 3);
    std::vector<float> pixels(rays.size() * 4), details(rays.size() * 4);
    target->readRgba32F(pixels, 0);
    target->readRgba32F(details, 1);
    std::vector<ProbedAnswer> answers;
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        answers.push_back({.colour = {pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]},
                           .hitDistance = details[i],
                           .parts = static_cast<int>(details[i + 1])});
    }
    return answers;
}

}  // namespace volcast::support
