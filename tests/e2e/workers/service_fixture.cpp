#include "tests/e2e/workers/service_fixture.h"

#include <algorithm>
#include <cstring>

#include "renderer/data/mesh_builder.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/data/volume_builder.h"
#include "renderer/scene/default_scene.h"
#include "server/workers/isolating_service.h"

namespace volcast::test {

using workers::RenderedFrame;

template <class Predicate>
bool Events::waitUntil(Predicate predicate) {
    std::unique_lock lock{mutex_};
    return changed_.wait_for(lock, kPatience, predicate);
}

workers::RenderEvents Events::callbacks() {
    return {.rendered =
                [this](RenderedFrame frame) {
                    const std::scoped_lock lock{mutex_};
                    frames_.push_back(std::move(frame));
                    changed_.notify_all();
                },
            .failed =
                [this](std::uint64_t view, std::uint64_t tag, Error error) {
                    const std::scoped_lock lock{mutex_};
                    failures_.push_back({.view = view, .tag = tag, .error = std::move(error)});
                    changed_.notify_all();
                },
            .measured =
                [this](std::uint64_t view, std::uint64_t, Result<accuracy::Measurement> result) {
                    const std::scoped_lock lock{mutex_};
                    measurements_.emplace_back(view, std::move(result));
                    changed_.notify_all();
                },
            .recovering =
                [this](const std::vector<std::uint64_t>& views) {
                    const std::scoped_lock lock{mutex_};
                    recovering_.insert(recovering_.end(), views.begin(), views.end());
                    changed_.notify_all();
                }};
}

std::optional<RenderedFrame> Events::waitForFrame(
    std::uint64_t view, const std::function<bool(const RenderedFrame&)>& accept) {
    std::optional<RenderedFrame> found;
    waitUntil([&] {
        for (const RenderedFrame& frame : frames_) {
            if (frame.view == view && accept(frame)) found = frame;
        }
        return found.has_value();
    });
    return found;
}

std::optional<RenderedFrame> Events::waitForTag(std::uint64_t view, std::uint64_t tag) {
    std::optional<RenderedFrame> found;
    waitUntil([&] {
        for (const RenderedFrame& frame : frames_) {
            if (frame.view == view && frame.tag == tag) found = frame;
        }
        for (const Failure& failure : failures_) {
            if (failure.view != view || failure.tag != tag) continue;
            ADD_FAILURE() << failure.error.message;
            return true;
        }
        return found.has_value();
    });
    return found;
}

std::optional<Error> Events::waitForFailure(std::uint64_t view, std::uint64_t tag) {
    std::optional<Error> found;
    waitUntil([&] {
        for (const Failure& failure : failures_) {
            if (failure.view == view && failure.tag == tag) found = failure.error;
        }
        return found.has_value();
    });
    return found;
}

bool Events::waitForRecovering(std::uint64_t view, std::size_t times) {
    return waitUntil([&] {
        return static_cast<std::size_t>(std::count(recovering_.begin(), recovering_.end(), view)) >=
               times;
    });
}

std::optional<Result<accuracy::Measurement>> Events::waitForMeasurement(std::uint64_t view) {
    std::optional<Result<accuracy::Measurement>> found;
    waitUntil([&] {
        for (const auto& [of, result] : measurements_) {
            if (of == view) found = result;
        }
        return found.has_value();
    });
    return found;
}

bool Events::hasFailure(std::uint64_t view, std::uint64_t tag) const {
    const std::scoped_lock lock{mutex_};
    return std::ranges::any_of(failures_, [&](const Failure& failure) {
        return failure.view == view && failure.tag == tag;
    });
}

bool Events::hasMeasurement() const {
    const std::scoped_lock lock{mutex_};
    return !measurements_.empty();
}

std::size_t Events::framesOf(std::uint64_t view) const {
    const std::scoped_lock lock{mutex_};
    return static_cast<std::size_t>(
        std::count_if(frames_.begin(), frames_.end(),
                      [view](const RenderedFrame& frame) { return frame.view == view; }));
}

std::vector<std::uint64_t> Events::viewsInOrder() const {
    const std::scoped_lock lock{mutex_};
    std::vector<std::uint64_t> views;
    for (const RenderedFrame& frame : frames_) views.push_back(frame.view);
    return views;
}

data::Dataset blockVolume(int side) {
    std::vector<float> values;
    for (int z = 0; z < side; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                values.push_back(static_cast<float>(x + 2 * y + 3 * z) /
                                 static_cast<float>(6 * side));
            }
        }
    }
    data::VolumeInput input;
    input.size = glm::ivec3(side);
    input.spacing = glm::dvec3(1.0 / (side - 1));
    input.channels.push_back({.name = "ramp", .unit = {}, .voxels = {}});
    std::vector<std::byte>& bytes = input.channels.back().voxels;
    bytes.resize(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return data::buildVolume(std::move(input)).value();
}

data::Dataset blockMesh() {
    // A cube of five tetrahedra with a linear field.
    data::MeshInput input;
    input.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                    {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
    input.cells = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    data::FieldInput field{.name = "height",
                           .unit = {},
                           .association = data::Association::kVertex,
                           .steps = {{}},
                           .times = {}};
    for (const glm::dvec3& point : input.points) field.steps[0].push_back(point.z + 0.5 * point.x);
    input.fields.push_back(std::move(field));
    return data::buildMesh(std::move(input)).value();
}

scene::Scene Service::scene(const std::string& dataset, scene::RayModel model) const {
    const data::DatasetSummary& summary = dataset == "mesh" ? mesh : volume;
    scene::Scene scene = scene::defaultScene(dataset, summary);
    scene.layers = {
        scene::defaultLayer(dataset, summary, dataset == "mesh" ? "height" : "ramp", model)};
    return scene;
}

workers::RenderRequest Service::request(std::uint64_t view, std::uint64_t tag,
                                        const std::string& dataset) const {
    workers::RenderRequest request;
    request.view = view;
    request.tag = tag;
    request.scene = scene(dataset, scene::RayModel::kVolume);
    request.size = {96, 64};
    return request;
}

workers::RenderRequest Service::endlessRequest(std::uint64_t view, std::uint64_t tag) const {
    workers::RenderRequest request = this->request(view, tag);
    request.scene.layers[0].stepWorld = 1e-4;
    request.size = {4096, 4096};
    // Nothing is opaque, so that no ray ends early.
    for (data::ControlPoint& point : request.scene.layers[0].map.points) point.extinction = 1e-3F;
    return request;
}

std::optional<RenderedFrame> Service::draw(const workers::RenderRequest& request) const {
    service->submit(request);
    return events->waitForTag(request.view, request.tag);
}

int Service::sparePid(int before) const {
    int found = 0;
    // One status tells both: that of a spare that died stands until the supervisor's turn ends.
    eventually([&] {
        const workers::RenderStatus now = service->status();
        if (now.spareReady && now.sparePid != before) found = now.sparePid;
        return found != 0;
    });
    return found;
}

workers::RenderSettings quickSettings() {
    workers::RenderSettings settings;
    settings.frameDeadline = std::chrono::milliseconds{20'000};
    settings.startDeadline = std::chrono::milliseconds{60'000};
    settings.heartbeatInterval = std::chrono::milliseconds{100};
    settings.heartbeatDeadline = std::chrono::milliseconds{1'500};
    return settings;
}

namespace {

using Created = Result<std::unique_ptr<workers::RenderService>>;

Service started(const std::function<Created(workers::RenderEvents)>& create) {
    Service started;
    const data::Dataset volume = blockVolume(24);
    const data::Dataset mesh = blockMesh();
    started.volume = data::summarize(volume);
    started.mesh = data::summarize(mesh);
    auto service = create(started.events->callbacks());
    if (!service) {
        ADD_FAILURE() << service.error().message;
        return started;
    }
    started.service = *std::move(service);
    started.service->addDataset("volume", data::pack(volume).value());
    started.service->addDataset("mesh", data::pack(mesh).value());
    return started;
}

}  // namespace

Service startService(const workers::RenderSettings& settings) {
    return started([&](workers::RenderEvents events) {
        return workers::RenderService::create(settings, std::move(events));
    });
}

Service startIsolatingService(const workers::RenderSettings& settings) {
    return started([&](workers::RenderEvents events) {
        return workers::createIsolatingService(settings, std::move(events));
    });
}

}  // namespace volcast::test
