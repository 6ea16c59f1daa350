#include "tests/support/numerics/weights_probe.h"

#include <algorithm>
#include <array>

#include "renderer/gpu/target.h"
#include "renderer/shading/psi_table.h"
#include "renderer/shading/shared.h"

namespace volcast::support {
namespace {

constexpr std::size_t kRow = 1024;  // as in chunks/weights_main.glsl
constexpr std::size_t kBatch = kRow * 256;

}  // namespace

shading::ChunkSource chunksWithProbes() {
    return [probes = shading::chunksFrom(VOLCAST_SOURCE_DIR "/tests/support/numerics/chunks"),
            program = shading::embeddedChunks()](std::string_view path) {
        std::optional<std::string> text = program(path);
        return text ? text : probes(path);
    };
}

Result<WeightsProbe> WeightsProbe::create(gpu::Device& device, const std::string& chunk) {
    const std::vector<float> table = shading::makePsiTable();
    auto buffer = gpu::Buffer::create(
        device,
        {.bytes = table.size() * 4, .texels = gpu::TexelFormat::kR32F, .label = "psi table"},
        std::as_bytes(std::span{table}));
    if (!buffer) return buffer.error();
    WeightsProbe probe{device, std::move(*buffer),
                       shading::ProgramCache{device, chunksWithProbes()}};
    const auto program = probe.programs_.pass(shading::kFullScreenVertex, chunk,
                                              {{"kPsiTableSide", shading::kPsiTableSide}});
    if (!program) return program.error();
    probe.program_ = *program;
    return probe;
}

Result<void> WeightsProbe::batch(std::span<const glm::vec2> pairs,
                                 std::vector<glm::vec3>& answers) const {
    const auto depths = gpu::Buffer::create(
        *device_,
        {.bytes = pairs.size_bytes(), .texels = gpu::TexelFormat::kRg32F, .label = "depths"},
        std::as_bytes(pairs));
    if (!depths) return depths.error();
    const glm::ivec2 size{static_cast<int>(kRow), static_cast<int>((pairs.size() - 1) / kRow + 1)};
    const auto texture = gpu::Texture2D::create(*device_, {.size = size, .label = "weights"});
    if (!texture) return texture.error();
    const std::array colours{&*texture};
    const auto target = gpu::Target::create(*device_, "weights", colours);
    if (!target) return target.error();
    target->begin({});
    program_->use();
    depths->bindTexels(5);
    psiTable_.bindTexels(shading::shared::kPsiTableUnit);
    device_->draw(gpu::Primitive::kTriangles, 3);
    std::vector<float> pixels(kRow * static_cast<std::size_t>(size.y) * 4);
    target->readRgba32F(pixels);
    // Row 0 of what is read is that of gl_FragCoord.y = 0.5.
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const float* pixel = &pixels[i * 4];
        answers.emplace_back(pixel[0], pixel[1], pixel[2]);
    }
    return {};
}

Result<std::vector<glm::vec3>> WeightsProbe::operator()(std::span<const glm::vec2> pairs) const {
    std::vector<glm::vec3> answers;
    answers.reserve(pairs.size());
    while (!pairs.empty()) {
        const std::size_t count = std::min(pairs.size(), kBatch);
        if (auto done = batch(pairs.first(count), answers); !done) return done.error();
        pairs = pairs.subspan(count);
    }
    return answers;
}

}  // namespace volcast::support
