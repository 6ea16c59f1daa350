#include "renderer/scene/render.h"

#include <algorithm>
#include <map>

#include "renderer/gpu/timer.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/frame_report.h"
#include "renderer/scene/layer_content.h"
#include "renderer/scene/layer_draw.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scene_diff.h"
#include "renderer/scene/user_controls.h"
#include "renderer/scene/validate.h"

namespace volcast::scene {
namespace {

constexpr int kFewestRows = 64;  ///< Drawn at once: llvmpipe's tiles have as many.

// Rays that meet no opaque layer end nowhere.
constexpr float kNoSurface = 3.0e38F;

/// How much of a view's last picture has to be made again.
enum class Work { kNothing, kResolve, kAll };

Counters operator-(const Counters& after, const Counters& before) {
    return {.bufferUploads = after.bufferUploads - before.bufferUploads,
            .textureUploads = after.textureUploads - before.textureUploads,
            .uploadedBytes = after.uploadedBytes - before.uploadedBytes,
            .programsBuilt = after.programsBuilt - before.programsBuilt,
            .drawCalls = after.drawCalls - before.drawCalls,
            .framesDrawn = after.framesDrawn - before.framesDrawn};
}

Result<void> checkTarget(PictureSize size, const FrameTarget& target) {
    const std::size_t values = static_cast<std::size_t>(size.x) * size.y * 4;
    for (const std::size_t given : {target.rgba8.size(), target.rgba32f.size()}) {
        if (given == 0 || given == values) continue;
        return fail(ErrorCode::kInvalidArgument, "pixels: room for " + std::to_string(given) +
                                                     " values, the picture has " +
                                                     std::to_string(values));
    }
    return {};
}

class DeviceRenderer final : public Renderer {
public:
    DeviceRenderer(gpu::Device& device, const shading::ChunkSource& chunks,
                   const plan::Limits& limits)
        : device_{device}, programs_{device, chunks}, limits_{limits} {
        context_.device = &device_;
        context_.programs = &programs_;
        context_.bricks = BrickPools{limits};
    }

    Result<void> open() {
        const Result<bool> exact = volume::filtersExactly(device_, programs_);
        if (!exact) return exact.error();
        context_.filterInHardware = *exact;
        return device_.check("the filter probe");
    }

    void addDataset(const std::string& id, data::Dataset dataset) override {
        datasets_.insert_or_assign(
            id, std::make_unique<CachedDataset>(std::move(dataset), ++generation_));
    }
    void removeDataset(const std::string& id) override { datasets_.erase(id); }
    [[nodiscard]] const data::Dataset* dataset(const std::string& id) const override {
        const auto found = datasets_.find(id);
        return found == datasets_.end() ? nullptr : &found->second->data();
    }
    void dropView(std::uint64_t view) override {
        views_.erase(view);
        context_.bricks.dropView(view);
    }
    [[nodiscard]] const Counters& counters() const noexcept override { return counters_; }

    Result<FrameInfo> render(std::uint64_t view, const Scene& scene, PictureSize size,
                             const FrameTarget& target,
                             const plan::SceneEvidence& evidence) override;

private:
    Result<Summaries> validated(const Scene& scene, PictureSize size, const FrameTarget& target);
    Result<void> takeCodes(Frame& frame);
    [[nodiscard]] Work workFor(const Frame& frame) const;
    Result<void> prepare(Frame& frame);
    Result<void> prepareLayer(Frame& frame, LayerDraw& draw);
    Result<void> sendBlocks(Frame& frame);
    [[nodiscard]] Progress progressOf(const Frame& frame);
    /// False where there is more to draw than a part of it.
    Result<bool> drawLayers(const Frame& frame, Progress& progress);
    Result<void> drawLayer(const Frame& frame, const LayerDraw& draw, Rows rows);
    Result<void> resolve(const Frame& frame);
    Result<void> make(Frame& frame, Work work, FrameInfo& info);
    Result<void> readBack(const Picture& picture, const FrameTarget& target);
    void countWork();

    gpu::Device& device_;
    shading::ProgramCache programs_;
    plan::Limits limits_;
    DrawContext context_;
    std::map<std::string, std::unique_ptr<CachedDataset>> datasets_;
    std::map<std::uint64_t, View> views_;
    std::uint64_t generation_ = 0;
    Counters counters_;
};

Result<Summaries> DeviceRenderer::validated(const Scene& scene, PictureSize size,
                                            const FrameTarget& target) {
    Result<void> valid = validate(size);
    if (valid) valid = checkTarget(size, target);
    if (valid) valid = validate(scene);
    if (!valid) return valid.error();
    Summaries summaries;
    for (const Layer& layer : scene.layers) {
        const auto found = datasets_.find(layer.dataset);
        if (found != datasets_.end()) summaries.emplace(layer.dataset, found->second->summary());
    }
    valid = validate(scene, summaries);
    if (!valid) return valid.error();
    return summaries;
}

Result<FrameInfo> DeviceRenderer::render(std::uint64_t view, const Scene& scene, PictureSize size,
                                         const FrameTarget& target,
                                         const plan::SceneEvidence& evidence) {
    if (!device_.alive()) return fail(ErrorCode::kDeviceLost, "the device was given up");
    countWork();  // The device may have worked for others since the last call.
    const Counters before = counters_;
    const Result<Summaries> summaries = validated(scene, size, target);
    if (!summaries) return summaries.error();
    FrameInfo info;
    info.plan = plan::plan(scene, *summaries, evidence, limits_);
    Frame frame;
    frame.view = &views_[view];
    frame.scene = &scene;
    frame.size = size;
    frame.plan = &info.plan;
    frame.countsSteps = target.countsSteps;
    frame.partMs = target.countsSteps ? 0.0 : target.partMs;
    ++context_.frame;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        CachedDataset& dataset = *datasets_.at(layer.dataset);
        frame.generations[layer.dataset] = dataset.generation();
        const plan::LayerPlan& planned = info.plan.layers[i];
        if (!planned.drawn || !planned.drawnWith.empty()) continue;
        LayerDraw& draw = frame.draws.emplace_back();
        draw.index = i;
        draw.layer = &layer;
        draw.plan = &planned;
        draw.dataset = &dataset;
    }
    if (const Result<void> coded = takeCodes(frame); !coded) return coded.error();
    const Work work = workFor(frame);
    std::map<data::VoxelType, int> bricked;
    for (const LayerDraw& draw : frame.draws) {
        if (!draw.plan->has(plan::kBricks)) continue;
        ++bricked[draw.dataset->summary().voxelType];
        frame.partMs = 0.0;
    }
    context_.bricks.begin(view, context_.frame, std::move(bricked), target.complete);
    const Result<void> made = make(frame, work, info);
    countWork();
    if (!made) return made.error();
    if (!info.finished) return info;
    gpu::Timer timer{device_};
    const Result<void> read = readBack(*frame.view->picture, target);
    if (!read) return read.error();
    const Result<double> readMs = timer.lapMs();
    if (!readMs) return readMs.error();
    info.readbackMs = *readMs;
    info.drawn = work != Work::kNothing;
    info.bricks = bricksOf(frame);
    info.ready = frame.view->ready;
    info.orders = ordersOf(frame);
    if (frame.countsSteps) info.steps = stepsOf(frame);
    for (const LayerOrder& order : info.orders) tellOrder(order, info.plan);
    for (const LayerBricks& bricks : info.bricks) tellBricks(bricks, info.plan);
    if (info.drawn) ++counters_.framesDrawn;
    info.work = counters_ - before;
    return info;
}

/// What the draws need of users' code; what is wrong with it is told before anything is drawn.
Result<void> DeviceRenderer::takeCodes(Frame& frame) {
    for (LayerDraw& draw : frame.draws) {
        if (!runsUserCode(*draw.layer)) continue;
        Result<UserCode> code =
            context_.codes.of(*draw.layer, draw.dataset->summary(), programs_.chunks(),
                              "layers[" + std::to_string(draw.index) + "]");
        if (!code) return std::move(code).error();
        draw.code = *std::move(code);
    }
    return {};
}

Work DeviceRenderer::workFor(const Frame& frame) const {
    const View& view = *frame.view;
    if (frame.countsSteps || view.stale || !view.ready || view.picture == nullptr ||
        view.picture->size != frame.size) {
        return Work::kAll;
    }
    for (const auto& [id, generation] : frame.generations) {
        const auto known = view.generations.find(id);
        if (known == view.generations.end() || known->second != generation) return Work::kAll;
    }
    const SceneDiff changes = diff(view.scene, *frame.scene);
    if (changes.empty()) return Work::kNothing;
    const bool onlyBackground = !changes.camera && !changes.clipping && !changes.accuracy &&
                                !changes.order && changes.layers.empty();
    return onlyBackground ? Work::kResolve : Work::kAll;
}

/// Makes the view's picture; on an error its last one stays readable.
Result<void> DeviceRenderer::make(Frame& frame, Work work, FrameInfo& info) {
    if (work == Work::kNothing) return {};
    View& view = *frame.view;
    std::unique_ptr<Picture> larger;
    const bool opaque = std::ranges::any_of(frame.draws, isOpaque);
    if (view.picture == nullptr || view.picture->size != frame.size ||
        (opaque && !view.picture->hasOpaque)) {
        Result<std::unique_ptr<Picture>> made = Picture::create(device_, frame.size, opaque);
        if (!made) return made.error();
        larger = std::move(*made);
    }
    frame.picture = larger != nullptr ? larger.get() : view.picture.get();
    gpu::Timer timer{device_};
    Result<void> done = prepare(frame);
    if (!done) return done;
    const Result<double> uploadMs = timer.lapMs();
    if (!uploadMs) return uploadMs.error();
    Progress progress = progressOf(frame);
    view.progress.reset();
    if (work == Work::kAll) {
        if (larger == nullptr) view.stale = true;
        const Result<bool> all = drawLayers(frame, progress);
        if (!all) return all.error();
        info.finished = *all;
    }
    if (info.finished) {
        done = resolve(frame);
        if (!done) return done;
    }
    const Result<double> drawMs = timer.lapMs();
    if (!drawMs) return drawMs.error();
    info.uploadMs = progress.uploadMs += *uploadMs;
    info.drawMs = progress.drawMs += *drawMs;
    if (larger != nullptr) view.picture = std::move(larger);
    if (!info.finished) {
        view.stale = true;
        progress.scene = *frame.scene;
        progress.size = frame.size;
        progress.plan = frame.plan->id;
        progress.generations = std::move(frame.generations);
        view.progress = std::move(progress);
        return {};
    }
    view.scene = *frame.scene;
    view.generations = std::move(frame.generations);
    view.stale = false;
    view.ready = std::ranges::all_of(
        bricksOf(frame), [](const LayerBricks& bricks) { return bricks.report.ready(); });
    context_.bricks.end(view.ready);
    std::erase_if(view.layers, [&](const auto& entry) {
        return std::ranges::none_of(frame.scene->layers,
                                    [&](const Layer& layer) { return layer.id == entry.first; });
    });
    return {};
}

/// Brings to the GPU what the draws need and it does not have.
Result<void> DeviceRenderer::prepare(Frame& frame) {
    View& view = *frame.view;
    std::vector<data::Box> boxes;
    for (const LayerDraw& draw : frame.draws) boxes.push_back(draw.dataset->summary().bounds);
    frame.depths = depthRange(frame.scene->camera, boxes);
    const Rays rays{.camera = frame.scene->camera, .size = frame.size, .depths = frame.depths};
    if (view.cameraVersion == 0 || view.rays != rays) ++view.cameraVersion;
    view.rays = rays;
    frame.cameraVersion = view.cameraVersion;
    for (LayerDraw& draw : frame.draws) {
        Result<void> prepared = prepareLayer(frame, draw);
        if (!prepared) return prepared;
    }
    Result<void> sent = sendBlocks(frame);
    if (!sent) return sent;
    return device_.check("uploading the scene");
}

Result<void> DeviceRenderer::prepareLayer(Frame& frame, LayerDraw& draw) {
    LayerState& state = frame.view->layers[draw.layer->id];
    // What one evaluator keeps is of no use to the other.
    if (state.generation != draw.dataset->generation() || state.projected != isProjected(draw)) {
        state.walk = mesh::WalkState::create();
        state.projection = mesh::ProjectionState::create();
        state.generation = draw.dataset->generation();
        state.projected = isProjected(draw);
    }
    draw.state = &state;
    draw.constants.push_back({"kEndsAtSurfaces", draw.plan->has(plan::kEndsAtSurfaces)});
    if (draw.code) {
        if (auto set = state.controls.set(device_, draw.code->texels); !set) return set;
    } else if (needsField(*draw.layer)) {
        Result<void> set =
            state.map.set(device_, layerContent(*draw.layer, *draw.plan, frame.scene->layers,
                                                frame.plan->layers, draw.dataset->summary()));
        if (!set) return set;
        draw.levels = state.map.levels();
        const std::vector<shading::Constant> constants = state.map.constants();
        draw.constants.insert(draw.constants.end(), constants.begin(), constants.end());
    }
    return draw.dataset->summary().isMesh ? prepareMesh(context_, draw)
                                          : prepareVoxels(context_, frame, draw);
}

Result<void> DeviceRenderer::sendBlocks(Frame& frame) {
    std::vector<LayerBlock> blocks(frame.scene->layers.size());
    for (const LayerDraw& draw : frame.draws) {
        blocks[draw.index] =
            layerBlock(frame.size, frame.depths, *frame.scene, *draw.layer, draw.dataset->data(),
                       draw.dataset->summary(), draw.plan->stepWorld);
        if (draw.emptySpace == nullptr) continue;
        blocks[draw.index].shownLow = glm::vec4(draw.emptySpace->box()[0], 0.0F);
        blocks[draw.index].shownHigh = glm::vec4(draw.emptySpace->box()[1], 0.0F);
    }
    return frame.view->blocks.set(device_, frame.scene->background, blocks);
}

/// Where to go on: where the view's last picture stopped if it is this one, else at its beginning.
Progress DeviceRenderer::progressOf(const Frame& frame) {
    const std::optional<Progress>& last = frame.view->progress;
    const bool goesOn = last && frame.partMs > 0.0 && last->size == frame.size &&
                        last->plan == frame.plan->id && last->generations == frame.generations &&
                        last->scene == *frame.scene;
    return goesOn ? *last : Progress{};
}

Result<bool> DeviceRenderer::drawLayers(const Frame& frame, Progress& progress) {
    std::vector<const LayerDraw*> order;
    for (const LayerDraw& draw : frame.draws) order.push_back(&draw);
    std::stable_partition(order.begin(), order.end(),
                          [](const LayerDraw* draw) { return isOpaque(*draw); });
    if (progress.begins()) {
        const Picture& picture = *frame.picture;
        picture.transparentPass.clearColour(0, glm::vec4(0.0F));
        if (!order.empty() && isOpaque(*order.front())) {
            picture.opaquePass.clearColour(1, glm::vec4(kNoSurface));
            picture.opaquePass.clearDepth();
        }
    }
    gpu::Timer timer{device_};
    double spentMs = 0.0;
    for (; progress.layer < order.size(); ++progress.layer, progress.row = 0) {
        const LayerDraw& draw = *order[progress.layer];
        int rows = frame.partMs > 0.0 && goesByRows(draw) ? kFewestRows : frame.size.y;
        while (progress.row < frame.size.y) {
            const int end = std::min(progress.row + rows, frame.size.y);
            Result<void> drawn = drawLayer(frame, draw, {.first = progress.row, .end = end});
            if (drawn) drawn = device_.check("layer \"" + draw.layer->id + "\"");
            if (!drawn) return drawn.error();
            progress.row = end;
            if (frame.partMs <= 0.0) continue;
            const Result<double> ms = timer.lapMs();
            if (!ms) return ms.error();
            spentMs += *ms;
            const bool more = end < frame.size.y || progress.layer + 1 < order.size();
            if (spentMs >= frame.partMs && more) return false;
            if (*ms < frame.partMs / 4) rows *= 2;
        }
    }
    return true;
}

Result<void> DeviceRenderer::drawLayer(const Frame& frame, const LayerDraw& draw, Rows rows) {
    frame.view->blocks.bindLayer(draw.index);
    if (draw.code) {
        draw.state->controls.bind();
    } else if (needsField(*draw.layer)) {
        draw.state->map.bind();
    }
    if (!isOpaque(draw) && draw.plan->has(plan::kEndsAtSurfaces)) {
        frame.picture->distance.bind(shading::shared::kOpaqueDistanceUnit);
    }
    const gpu::Target* target =
        isOpaque(draw) ? &frame.picture->opaquePass : &frame.picture->transparentPass;
    return draw.dataset->summary().isMesh ? drawMesh(context_, frame, draw, *target)
                                          : drawVoxels(context_, frame, draw, *target, rows);
}

Result<void> DeviceRenderer::resolve(const Frame& frame) {
    const Result<const gpu::Program*> program =
        programs_.pass(shading::kFullScreenVertex, "lib/resolve.glsl");
    if (!program) return program.error();
    frame.picture->resolvePass.begin({});
    (*program)->use();
    frame.picture->layers.bind(0);
    frame.view->blocks.bindBackground(0);
    device_.draw(gpu::Primitive::kTriangles, 3);
    return device_.check("resolving the picture");
}

Result<void> DeviceRenderer::readBack(const Picture& picture, const FrameTarget& target) {
    if (!target.rgba8.empty()) picture.resolvePass.readRgba8(target.rgba8);
    if (!target.rgba32f.empty()) picture.transparentPass.readRgba32F(target.rgba32f);
    return device_.check("reading the picture");
}

void DeviceRenderer::countWork() {
    const gpu::Counters& work = device_.counters();
    counters_.bufferUploads = work.bufferUploads;
    counters_.textureUploads = work.textureUploads;
    counters_.uploadedBytes = work.uploadedBytes;
    counters_.programsBuilt = work.programsBuilt;
    counters_.drawCalls = work.drawCalls;
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(gpu::Device& device,
                                                   const shading::ChunkSource& chunks,
                                                   const plan::Limits& limits) {
    auto renderer = std::make_unique<DeviceRenderer>(device, chunks, limits);
    const Result<void> opened = renderer->open();
    if (!opened) return opened.error();
    return std::unique_ptr<Renderer>{std::move(renderer)};
}

}  // namespace volcast::scene
