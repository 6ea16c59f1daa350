#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "renderer/base/memfd.h"
#include "server/session/views.h"

namespace volcast::session::test {

/// Writes down what is asked of it; the test draws. What other threads ask needs the lock to read.
class ScriptedRender final : public workers::RenderService {
public:
    void addDataset(const std::string&, base::FileDescriptor) override {}
    void removeDataset(const std::string& id) override {
        const std::lock_guard lock{mutex};
        removed.push_back(id);
    }
    void submit(workers::RenderRequest request) override {
        const std::lock_guard lock{mutex};
        requests.push_back(std::move(request));
    }
    void measure(workers::MeasureRequest request) override {
        const std::lock_guard lock{mutex};
        measures.push_back(std::move(request));
    }
    void stopMeasuring(std::uint64_t view) override {
        const std::lock_guard lock{mutex};
        stopped.push_back(view);
    }
    void pick(workers::PickRequest request) override {
        const std::lock_guard lock{mutex};
        picks.push_back(std::move(request));
    }
    void dropView(std::uint64_t view) override {
        const std::lock_guard lock{mutex};
        dropped.push_back(view);
    }
    [[nodiscard]] workers::RenderStatus status() const override { return {}; }
    /// Waits until `list` is of that size: a thread of the view's may be about to add to it.
    template <class List>
    bool has(const List& list, std::size_t count) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds{30};
        while (std::chrono::steady_clock::now() < until) {
            {
                const std::lock_guard lock{mutex};
                if (list.size() >= count) return list.size() == count;
            }
            std::this_thread::sleep_for(std::chrono::microseconds{200});
        }
        return false;
    }
    std::mutex mutex;
    std::vector<workers::RenderRequest> requests;
    std::vector<workers::MeasureRequest> measures;
    std::vector<workers::PickRequest> picks;
    std::vector<std::uint64_t> stopped, dropped;
    std::vector<std::string> removed;
};

/// The picture that `request` asks for, black.
inline workers::RenderedFrame drawn(const workers::RenderRequest& request) {
    auto picture = std::make_shared<workers::Picture>();
    picture->size = request.size;
    picture->rgba8.resize(static_cast<std::size_t>(request.size.x) * request.size.y * 4);
    workers::RenderedFrame frame;
    frame.view = request.view;
    frame.tag = request.tag;
    frame.picture = picture;
    frame.drawn = true;
    return frame;
}

/// A cube of voxels with one channel, without its bytes.
inline Result<workers::ImportedDataset> importCube(
    const workers::ImportRequest&, const workers::ImportSettings&,
    const std::function<void(const std::string&, double)>&) {
    workers::ImportedDataset imported;
    imported.packed = *base::createMemfd("cube", 1);
    imported.summary.isMesh = false;
    imported.summary.bounds = {.min = glm::dvec3{0.0}, .max = glm::dvec3{1.0}};
    imported.summary.voxels = glm::ivec3{4};
    imported.summary.spacing = glm::dvec3{0.25};
    data::FieldSummary field;
    field.name = "f";
    field.range = field.spread.usual = {.min = 0.0F, .max = 1.0F};
    imported.summary.fields.push_back(field);
    return imported;
}

/// The demo datasets, each of them a cube.
inline std::unique_ptr<Catalogue> cubes(ScriptedRender& render) {
    CatalogueDesc desc;
    desc.importer = importCube;
    return *Catalogue::create(std::move(desc), render);
}

/// The first dataset, once it is loaded; empty where that fails.
inline std::string loadedFirst(Catalogue& catalogue) {
    const std::string id = catalogue.list().datasets(0).id();
    if (!catalogue.require(id)) return {};
    while (!catalogue.standing(id).loaded && !catalogue.standing(id).failed)
        std::this_thread::yield();
    return catalogue.standing(id).loaded ? id : std::string{};
}

}  // namespace volcast::session::test
