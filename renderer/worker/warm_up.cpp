#include "renderer/worker/warm_up.h"

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "renderer/data/mesh_builder.h"
#include "renderer/data/volume_builder.h"
#include "renderer/scene/default_scene.h"

namespace volcast::worker {

namespace {

constexpr const char* kDataset = "warm-up";
constexpr std::uint64_t kView = 0;  // The server numbers views from 1.
constexpr scene::PictureSize kSize{16, 16};

Result<data::Dataset> tinyMesh() {
    data::MeshInput input;
    input.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    input.cells = {{0, 1, 2, 3}};
    input.fields.push_back({.name = "f",
                            .unit = {},
                            .association = data::Association::kVertex,
                            .steps = {{0.0, 1.0, 2.0, 3.0}},
                            .times = {}});
    auto mesh = data::buildMesh(std::move(input));
    if (!mesh) return std::move(mesh).error();
    return data::Dataset{*std::move(mesh)};
}

Result<data::Dataset> tinyVolume() {
    constexpr int kSide = 4;
    std::vector<float> values(static_cast<std::size_t>(kSide * kSide * kSide));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    data::VolumeInput input;
    input.size = glm::ivec3(kSide);
    input.channels.push_back({.name = "f", .unit = {}, .voxels = std::move(bytes)});
    auto volume = data::buildVolume(std::move(input));
    if (!volume) return std::move(volume).error();
    return data::Dataset{*std::move(volume)};
}

struct Step {
    bool mesh;
    scene::RayModel model;
};

/// The likeliest first.
constexpr std::array<Step, kWarmUpSteps> kSteps{{{true, scene::RayModel::kVolume},
                                                 {false, scene::RayModel::kVolume},
                                                 {true, scene::RayModel::kSurface},
                                                 {true, scene::RayModel::kMip},
                                                 {false, scene::RayModel::kMip}}};

}  // namespace

Result<void> warmUp(scene::Renderer& renderer, std::uint32_t step) {
    if (step >= kSteps.size()) {
        return fail(ErrorCode::kInvalidArgument, "no warm-up step " + std::to_string(step));
    }
    auto dataset = kSteps[step].mesh ? tinyMesh() : tinyVolume();
    if (!dataset) return std::move(dataset).error();
    const data::DatasetSummary summary = data::summarize(*dataset);
    renderer.addDataset(kDataset, *std::move(dataset));
    scene::Scene scene = scene::defaultScene(kDataset, summary);
    scene.layers = {scene::defaultLayer(kDataset, summary, "f", kSteps[step].model)};
    std::vector<std::byte> pixels(std::size_t{4} * kSize.x * kSize.y);
    auto drawn = renderer.render(kView, scene, kSize, {.rgba8 = pixels, .rgba32f = {}});
    renderer.dropView(kView);
    renderer.removeDataset(kDataset);
    if (!drawn) return fail(drawn.error().code, "warm-up: " + drawn.error().message);
    return {};
}

}  // namespace volcast::worker
