#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/accuracy/measurement.h"
#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/picked.h"
#include "renderer/scene/scene.h"
#include "renderer/worker/fault_names.h"
#include "renderer/worker/pick_message.h"

namespace volcast::workers {

/// A picture as the worker drew it, copied out of shared memory; rows from the top.
struct Picture {
    scene::PictureSize size{0};
    std::vector<std::byte> rgba8;  ///< sRGB over the background, straight alpha.
    std::vector<float> rgba32f;    ///< Linear, premultiplied, no background; empty if unwanted.
};

struct RenderRequest {
    std::uint64_t view = 0;  ///< Unique in this server.
    std::uint64_t tag = 0;   ///< Comes back with the picture; the session puts input_seq here.
    scene::Scene scene;
    scene::PictureSize size{512, 512};
    bool hurried = false;  ///< Drawn as accuracy kFastest, whatever the scene asks for.
    bool wantFloat = false;
    std::string viewId = {};  ///< What the log calls the view.
    bool background = false;  ///< Drawn when no view waits for a picture.
    /// Nobody waits for it: it is drawn in parts, other views have their turns between them, and a
    /// newer request of its view ends it.
    bool patient = false;
};

/// One candidate of a picture to measure, in the name of a view.
struct MeasureRequest {
    std::uint64_t view = 0;
    std::uint64_t tag = 0;  ///< Comes back with the result.
    accuracy::Job job;
};

/// A pixel to pick, in the name of a view.
struct PickRequest {
    std::uint64_t view = 0;
    std::uint64_t tag = 0;  ///< Comes back with the place.
    worker::PickJob job;
};

struct WorkDone {
    std::uint64_t bufferUploads = 0, textureUploads = 0, uploadedBytes = 0, programsBuilt = 0,
                  drawCalls = 0, framesDrawn = 0;
};

struct RenderedFrame {
    std::uint64_t view = 0;
    std::uint64_t tag = 0;
    std::shared_ptr<const Picture> picture;
    plan::FramePlan plan;
    double waitMs = 0, uploadMs = 0, drawMs = 0, readbackMs = 0, copyMs = 0, cpuMs = 0;
    double workerPeakMb = 0;
    bool drawn = false;
    bool ready = true;  ///< False: the same request yields a better picture; see scene::FrameInfo.
    WorkDone work;
    std::uint32_t generation = 0;  ///< Of the worker; grows with each replacement.
};

inline constexpr std::uint64_t kLeastVolumeBudgetMib = 16;
inline constexpr std::uint64_t kMostVolumeBudgetMib = std::uint64_t{1} << 20;

struct RenderSettings {
    std::string workerPath;  ///< Empty: `volcast-worker` beside this program.
    /// Empty: surfaceless; "software", or a device as `doctor` lists it.
    std::string gpu;
    std::string cacheFolder;  ///< For the driver's shader cache; empty: a private temporary one.
    std::chrono::milliseconds frameDeadline{10'000};  ///< Upload, compile, link and draw together.
    std::chrono::milliseconds startDeadline{20'000};
    std::chrono::milliseconds datasetDeadline{120'000};  ///< To check and take over one dataset.
    std::chrono::milliseconds measureDeadline{120'000};  ///< For the reference and all frames.
    std::chrono::milliseconds heartbeatInterval{1'000};  ///< An idle worker is asked this often.
    std::chrono::milliseconds heartbeatDeadline{3'000};  ///< And has this long to answer.
    bool warmSpare = true;
    /// A view whose scenes take down workers again and again keeps to its last good one for a
    /// while, for the sake of others. See SceneTrust.
    bool pausesViews = true;
    std::optional<worker::FaultSpec> fault;  ///< Armed in each worker from its start.
    std::string shaderFolder;  ///< Chunks are read from here; empty: the embedded ones.
    /// Of GPU memory: a channel of voxels that takes more is drawn from a pool of bricks of so
    /// much.
    std::uint64_t volumeBudgetBytes = std::uint64_t{1} << 30;
};

struct RenderStatus {
    bool ready = false;
    std::uint32_t generation = 0;
    std::uint32_t losses = 0;  ///< Workers lost since start.
    std::uint32_t starts =
        0;  ///< Worker processes started, those that never became ready included.
    bool spareReady = false;
    int workerPid = 0;             ///< Of the one that draws now; 0: none.
    int sparePid = 0;              ///< Of the one that waits, ready or not; 0: none.
    std::size_t viewsWaiting = 0;  ///< For their turn.
    std::string glRenderer, glVersion;
    std::string lastLoss;    ///< "killed by signal 9", "missed its deadline of 10000 ms".
    std::string gpuGivenUp;  ///< Why the software device draws in the place of a GPU; empty: no.
};

/// Calls back on the service's own thread; must return soon and may call the service.
struct RenderEvents {
    std::function<void(RenderedFrame)> rendered = {};
    /// The request was refused or failed; the view keeps its last good picture.
    std::function<void(std::uint64_t view, std::uint64_t tag, Error)> failed = {};
    /// What was asked of measure(). kTimeout: it took longer than its deadline; kDeviceLost: two
    /// workers were lost over it, or one by a part of it that missed the frame's deadline.
    std::function<void(std::uint64_t view, std::uint64_t tag, Result<accuracy::Measurement>)>
        measured = {};
    /// What was asked of pick(); empty: the pixel shows no data. kDeviceLost: the worker was lost.
    std::function<void(std::uint64_t view, std::uint64_t tag, Result<std::optional<scene::Picked>>)>
        picked = {};
    /// The worker of these views was lost; their last requests are drawn again by themselves.
    std::function<void(std::vector<std::uint64_t> views)> recovering = {};
};

/// Draws pictures in `volcast-worker` processes and replaces them when they exit, are killed,
/// are stopped, hang, or miss a deadline. One worker draws, one warm spare waits.
///
/// Each view has a one-slot mailbox: a newer request replaces one that has not started. Views
/// take turns, a patient request one for each of its parts. A request in flight when its worker is
/// lost is drawn again by the next; one that loses two workers in a row fails with kDeviceLost and
/// does not take a third one down. All methods may be called from any thread.
class RenderService {
public:
    /// Starts the first worker and waits until it is ready.
    ///
    /// Errors: kNotFound (no worker program), kUnsupported (no EGL, GL too old; the worker's
    /// words), kTimeout, kIo.
    static Result<std::unique_ptr<RenderService>> create(RenderSettings settings,
                                                         RenderEvents events);
    virtual ~RenderService() = default;
    RenderService(const RenderService&) = delete;
    RenderService& operator=(const RenderService&) = delete;
    RenderService(RenderService&&) = delete;
    RenderService& operator=(RenderService&&) = delete;

    /// Gives every worker, now and later, the packed dataset; it must be sealed.
    virtual void addDataset(const std::string& id, base::FileDescriptor packed) = 0;
    virtual void removeDataset(const std::string& id) = 0;
    virtual void submit(RenderRequest request) = 0;
    /// Measured when no view waits for a picture, in parts that take about as long as one; replaces
    /// the view's request. dropView() takes it back, too.
    virtual void measure(MeasureRequest request) = 0;
    virtual void stopMeasuring(std::uint64_t view) = 0;
    /// Between pictures; replaces a request of the view that waits, which then is not answered.
    virtual void pick(PickRequest request) = 0;
    virtual void dropView(std::uint64_t view) = 0;
    /// Arms `fault` in the worker that draws `view`, or in its spare. A service without workers
    /// has none that could fail.
    virtual void injectFault(std::uint64_t /*view*/, const worker::FaultSpec& /*fault*/) {}
    [[nodiscard]] virtual RenderStatus status() const = 0;

protected:
    RenderService() = default;
};

}  // namespace volcast::workers
