#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/gpu/device.h"
#include "renderer/mesh/visibility_order.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/scene.h"
#include "renderer/shading/assemble.h"
#include "renderer/volume/bricked_layer.h"

namespace volcast::scene {

/// Work done on the GPU's account; tests read it to see that a diff costs what it should.
struct Counters {
    std::uint64_t bufferUploads = 0;
    std::uint64_t textureUploads = 0;
    std::uint64_t uploadedBytes = 0;
    std::uint64_t programsBuilt = 0;
    std::uint64_t drawCalls = 0;    ///< Draws and dispatches.
    std::uint64_t framesDrawn = 0;  ///< render() calls that drew; the others reused the picture.
};

/// In which order the cells of a layer were blended.
struct LayerOrder {
    std::string layer;
    mesh::OrderReport report;
};

/// What drawing a layer of a mesh took, in units of its evaluator.
struct LayerSteps {
    std::string layer;
    std::uint64_t walkSteps = 0;   ///< Of all rays; see mesh::WalkState::steps().
    std::uint64_t cellsDrawn = 0;  ///< By the projection.
};

/// From which bricks of a pyramid a layer was drawn.
struct LayerBricks {
    std::string layer;
    volume::BrickReport report;
};

/// What one call of render() made and took.
struct FrameInfo {
    plan::FramePlan plan;
    std::vector<LayerOrder> orders;   ///< Of the layers whose cells must come front to back.
    std::vector<LayerSteps> steps;    ///< Where FrameTarget::countsSteps.
    std::vector<LayerBricks> bricks;  ///< Of the layers that are drawn from bricks.
    /// False: bricks are missing, coarser ones stand in; the same call again loads more of them.
    bool ready = true;
    /// False: a part was drawn and no pixels were read; the same call again goes on. Times are
    /// those of all parts.
    bool finished = true;
    double uploadMs = 0.0;
    double drawMs = 0.0;  ///< Until the GPU was done.
    double readbackMs = 0.0;
    bool drawn = false;  ///< False: nothing had changed, the last picture was read again.
    Counters work;       ///< Of this call alone.
};

/// What is wanted of a frame, and where pixels go; rows from the top. Either may be empty.
struct FrameTarget {
    /// 4 bytes a pixel: sRGB-encoded, composited over the background, straight alpha.
    std::span<std::byte> rgba8 = {};
    /// 4 floats a pixel: linear, premultiplied, without background.
    std::span<float> rgba32f = {};
    bool complete = false;     ///< Loads all bricks that are needed, however long that takes.
    bool countsSteps = false;  ///< Draws anew, slower, and tells what every layer took.
    /// Drawing stops when it has taken so long and there is more, at the next row or layer where it
    /// can; 0: never. Layers from bricks are drawn whole: what they draw from changes in between.
    double partMs = 0.0;
};

/// Draws scenes of several views on one device; all calls on the device's thread.
///
/// Keeps what is on the GPU as a cache: datasets, and a picture and last scene for each view.
class Renderer {
public:
    /// Errors: kShaderBuild, kOutOfGpuMemory, kDeviceLost.
    static Result<std::unique_ptr<Renderer>> create(gpu::Device& device,
                                                    const shading::ChunkSource& chunks,
                                                    const plan::Limits& limits = {});
    virtual ~Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    Renderer(Renderer&&) = delete;
    Renderer& operator=(Renderer&&) = delete;

    /// Makes `dataset` drawable under `id`; replaces one of the same id. Uploads nothing until a
    /// scene needs it.
    virtual void addDataset(const std::string& id, data::Dataset dataset) = 0;
    virtual void removeDataset(const std::string& id) = 0;
    /// Null for one that is not there; good until it is replaced or removed.
    [[nodiscard]] virtual const data::Dataset* dataset(const std::string& id) const = 0;

    /// Draws `scene` for `view` at `size` and fills `target`; only what differs from the view's
    /// last scene is uploaded, compiled and drawn.
    ///
    /// `scene` is validated here against the data. On an error the view is as it was.
    /// Errors: as scene::validate, and kShaderBuild, kOutOfGpuMemory, kDeviceLost.
    /// `evidence`: as plan::plan() takes it.
    virtual Result<FrameInfo> render(std::uint64_t view, const Scene& scene, PictureSize size,
                                     const FrameTarget& target,
                                     const plan::SceneEvidence& evidence) = 0;
    Result<FrameInfo> render(std::uint64_t view, const Scene& scene, PictureSize size,
                             const FrameTarget& target) {
        return render(view, scene, size, target, {});
    }

    /// Frees what `view` holds; unknown views are fine.
    virtual void dropView(std::uint64_t view) = 0;

    [[nodiscard]] virtual const Counters& counters() const noexcept = 0;

protected:
    Renderer() = default;
};

}  // namespace volcast::scene
