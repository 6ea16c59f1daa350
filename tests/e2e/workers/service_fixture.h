#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/data/dataset.h"
#include "server/workers/render_service.h"
#include "tests/support/processes.h"

namespace volcast::test {

/// Writes down what a render service tells, and waits for it.
class Events {
public:
    workers::RenderEvents callbacks();

    /// The newest frame of `view` once `accept` says yes; nullopt: it never came.
    std::optional<workers::RenderedFrame> waitForFrame(
        std::uint64_t view, const std::function<bool(const workers::RenderedFrame&)>& accept);
    std::optional<workers::RenderedFrame> waitForTag(std::uint64_t view, std::uint64_t tag);
    std::optional<Error> waitForFailure(std::uint64_t view, std::uint64_t tag);
    bool waitForRecovering(std::uint64_t view, std::size_t times = 1);
    std::optional<Result<accuracy::Measurement>> waitForMeasurement(std::uint64_t view);

    [[nodiscard]] std::size_t framesOf(std::uint64_t view) const;
    [[nodiscard]] bool hasMeasurement() const;
    [[nodiscard]] bool hasFailure(std::uint64_t view, std::uint64_t tag) const;
    [[nodiscard]] std::vector<std::uint64_t> viewsInOrder() const;

private:
    struct Failure {
        std::uint64_t view = 0, tag = 0;
        Error error;
    };
    template <class Predicate>
    bool waitUntil(Predicate predicate);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<workers::RenderedFrame> frames_;
    std::vector<Failure> failures_;
    std::vector<std::pair<std::uint64_t, Result<accuracy::Measurement>>> measurements_;
    std::vector<std::uint64_t> recovering_;
};

data::Dataset blockVolume(int side);
data::Dataset blockMesh();

/// A service with the volume "volume" and the mesh "mesh", and what it told.
struct Service {
    std::shared_ptr<Events> events = std::make_shared<Events>();
    data::DatasetSummary volume, mesh;
    std::unique_ptr<workers::RenderService> service;

    [[nodiscard]] scene::Scene scene(const std::string& dataset, scene::RayModel model) const;
    [[nodiscard]] workers::RenderRequest request(std::uint64_t view, std::uint64_t tag,
                                                 const std::string& dataset = "volume") const;
    /// A request that no software rasteriser finishes within minutes.
    [[nodiscard]] workers::RenderRequest endlessRequest(std::uint64_t view,
                                                        std::uint64_t tag) const;
    /// Submits and waits for the picture.
    std::optional<workers::RenderedFrame> draw(const workers::RenderRequest& request) const;
    [[nodiscard]] int pid() const { return service->status().workerPid; }
    /// Waits for a warm spare that is another process than `before`; 0: there was none.
    [[nodiscard]] int sparePid(int before = 0) const;
};

/// Deadlines as short as a busy machine allows.
workers::RenderSettings quickSettings();
Service startService(const workers::RenderSettings& settings = quickSettings());
/// One that gives views with code of users workers of their own.
Service startIsolatingService(const workers::RenderSettings& settings = quickSettings());

}  // namespace volcast::test
