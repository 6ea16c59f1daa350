#include "server/workers/worker_process.h"

#include <algorithm>
#include <new>
#include <utility>

#include "renderer/worker/measure_message.h"
#include "renderer/worker/pick_message.h"
#include "renderer/worker/scene_message.h"

namespace volcast::workers {

namespace {

using std::chrono::milliseconds;

constexpr double kPartMs = 30.0;  ///< Of a patient picture: what others may wait for it.

/// What a driver and its tools read from the environment. LP_* is left out but for the number of
/// threads: a shader cache must never see two vector widths.
const std::vector<std::string> kEnvironment{
    "LD_LIBRARY_PATH=", "LIBGL_",  "MESA_", "EGL_",  "__EGL_", "__GL_", "GALLIUM_",
    "LP_NUM_THREADS=",  "NVIDIA_", "DRI_",  "ASAN_", "UBSAN_", "LSAN_", "TSAN_"};

SpawnDesc spawnDesc(const RenderSettings& settings, const std::string& cacheFolder, int channel) {
    SpawnDesc desc;
    desc.program =
        settings.workerPath.empty() ? besideThisProgram("volcast-worker") : settings.workerPath;
    desc.arguments = {"--cache-dir", cacheFolder, "--volume-budget",
                      std::to_string(settings.volumeBudgetBytes)};
    if (!settings.gpu.empty()) desc.arguments.insert(desc.arguments.end(), {"--gpu", settings.gpu});
    if (settings.fault) {
        desc.arguments.insert(desc.arguments.end(), {"--fault", worker::toText(*settings.fault)});
    }
    if (!settings.shaderFolder.empty()) {
        desc.arguments.insert(desc.arguments.end(), {"--shader-dir", settings.shaderFolder});
    }
    // Ours come first: the first of two equal names counts.
    desc.environment = {"MESA_SHADER_CACHE_DIR=" + cacheFolder,
                        "__GL_SHADER_DISK_CACHE_PATH=" + cacheFolder};
    for (std::string& variable : inheritedEnvironment(kEnvironment)) {
        desc.environment.push_back(std::move(variable));
    }
    desc.channel = channel;
    return desc;
}

Result<void> checkSize(const WorkerProcess::Message& message) {
    const std::size_t size = message.ByteSizeLong();
    if (size <= worker::kMaxChannelMessage) return {};
    return fail(ErrorCode::kLimitExceeded,
                "the scene takes " + std::to_string(size) + " bytes, at most " +
                    std::to_string(worker::kMaxChannelMessage) + " are allowed");
}

/// A slot far larger than its pictures is given back.
constexpr std::size_t kShrinkFactor = 8;
constexpr std::size_t kSmallSlot = std::size_t{16} << 20;

}  // namespace

Result<WorkerProcess> WorkerProcess::start(const RenderSettings& settings,
                                           const std::string& cacheFolder) {
    auto pair = worker::Channel::createPair();
    if (!pair) return std::move(pair).error();
    auto child = ChildProcess::spawn(spawnDesc(settings, cacheFolder, pair->theirs.get()));
    if (!child) return std::move(child).error();
    WorkerProcess process{*std::move(child), std::move(pair->ours)};
    process.owe(Owed::kReady, settings.startDeadline);
    return process;
}

void WorkerProcess::owe(Owed what, milliseconds limit) {
    if (owed_.empty()) owedSince_ = Clock::now();
    owed_.push_back({.what = what, .limit = limit});
}

void WorkerProcess::addDataset(const std::string& id, const SharedDescriptor& packed,
                               milliseconds limit) {
    Message message;
    message.mutable_add_dataset()->set_id(id);
    outbox_.push_back({.message = std::move(message), .descriptor = packed});
    owe(Owed::kDataset, limit);
}

void WorkerProcess::removeDataset(const std::string& id) {
    Message message;
    message.mutable_remove_dataset()->set_id(id);
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
}

void WorkerProcess::dropView(std::uint64_t view) {
    Message message;
    message.mutable_drop_view()->set_view(view);
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
}

void WorkerProcess::ping(milliseconds limit) {
    Message message;
    message.mutable_ping()->set_token(1);
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
    owe(Owed::kPong, limit);
}

void WorkerProcess::warmUp(std::uint32_t step, milliseconds limit) {
    Message message;
    message.mutable_warm_up()->set_step(step);
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
    owe(Owed::kWarmUp, limit);
}

Result<SharedDescriptor> WorkerProcess::prepareSlot(std::size_t bytes) {
    Slot& slot = slots_[slot_];
    const std::size_t now = slot.mapping.bytes.size();
    if (now >= bytes && (now <= kSmallSlot || now / kShrinkFactor <= bytes)) {
        return SharedDescriptor{};
    }
    slot.mapping = {};
    auto memory = base::createMemfd("volcast frame", bytes);
    if (!memory) return std::move(memory).error();
    auto mapping = base::map(*memory, true);
    if (!mapping) return std::move(mapping).error();
    slot.mapping = *std::move(mapping);
    return std::make_shared<const base::FileDescriptor>(*std::move(memory));
}

void WorkerProcess::markSlot(std::size_t colourBytes) {
    Slot& slot = slots_[slot_];
    for (std::byte& byte : slot.mark) byte = static_cast<std::byte>(marks_());
    if (colourBytes < 2 * slot.mark.size()) return;
    const std::span<std::byte> colours = slot.mapping.bytes.first(colourBytes);
    std::ranges::copy(slot.mark, colours.begin());
    std::ranges::copy(slot.mark, colours.last(slot.mark.size()).begin());
}

Result<void> WorkerProcess::render(std::uint64_t number, const RenderRequest& request,
                                   milliseconds limit) {
    slot_ = (slot_ + 1) % worker::kSlots;
    Message message;
    internal::v1::Render& render = *message.mutable_render();
    render.set_request(number);
    render.set_view(request.view);
    *render.mutable_scene() = worker::toMessage(request.scene);
    if (request.hurried) {
        render.mutable_scene()->mutable_accuracy()->set_kind(v1::Accuracy::FASTEST);
        render.mutable_scene()->mutable_accuracy()->clear_bound();
    }
    render.set_width(static_cast<std::uint32_t>(request.size.x));
    render.set_height(static_cast<std::uint32_t>(request.size.y));
    render.set_slot(slot_);
    render.set_want_float(request.wantFloat);
    if (request.patient) render.set_part_ms(kPartMs);
    render.set_new_slot(true);
    if (auto fits = checkSize(message); !fits) return fits;
    auto memory = prepareSlot(worker::slotBytes(request.size, request.wantFloat));
    if (!memory) return std::move(memory).error();
    render.set_new_slot(*memory != nullptr);
    markSlot(worker::slotBytes(request.size, false));
    outbox_.push_back({.message = std::move(message), .descriptor = *std::move(memory)});
    owe(Owed::kFrame, limit);
    return {};
}

Result<void> WorkerProcess::measure(std::uint64_t number, const accuracy::Job& job,
                                    milliseconds limit) {
    Message message;
    *message.mutable_measure() = worker::toMessage(job);
    message.mutable_measure()->set_request(number);
    if (auto fits = checkSize(message); !fits) return fits;
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
    owe(Owed::kMeasure, limit);
    return {};
}

Result<void> WorkerProcess::pick(std::uint64_t number, const worker::PickJob& job,
                                 milliseconds limit) {
    Message message;
    *message.mutable_pick() = worker::toMessage(job);
    message.mutable_pick()->set_request(number);
    if (auto fits = checkSize(message); !fits) return fits;
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
    owe(Owed::kPick, limit);
    return {};
}

void WorkerProcess::arm(const worker::FaultSpec& fault) {
    Message message;
    message.mutable_arm_fault()->set_fault(worker::toText(fault));
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
}

void WorkerProcess::stopMeasuring() {
    Message message;
    message.mutable_stop_measuring();
    outbox_.push_back({.message = std::move(message), .descriptor = nullptr});
}

Result<void> WorkerProcess::flush() {
    while (!outbox_.empty()) {
        const Outgoing& next = outbox_.front();
        std::vector<int> descriptors;
        if (next.descriptor) descriptors.push_back(next.descriptor->get());
        const Result<bool> sent = channel_.trySend(next.message, descriptors);
        if (!sent) return sent.error();
        if (!*sent) return {};
        outbox_.pop_front();
    }
    return {};
}

Result<void> WorkerProcess::settle(const Answer& answer) {
    const auto owed = owed_.empty() ? std::optional<Owed>{} : owed_.front().what;
    bool expected = false;
    switch (answer.body_case()) {
        case Answer::kReady: expected = owed == Owed::kReady; break;
        case Answer::kDatasetAdded: expected = owed == Owed::kDataset; break;
        case Answer::kRendered:
        case Answer::kRendering: expected = owed == Owed::kFrame; break;
        case Answer::kPong: expected = owed == Owed::kPong; break;
        case Answer::kWarmedUp: expected = owed == Owed::kWarmUp; break;
        case Answer::kMeasured:
        case Answer::kMeasuring: expected = owed == Owed::kMeasure; break;
        case Answer::kPicked: expected = owed == Owed::kPick; break;
        case Answer::kFailed: expected = owed && owed != Owed::kPong; break;
        case Answer::BODY_NOT_SET: break;
    }
    if (!expected) return fail(ErrorCode::kInvalidArgument, "answered what nobody asked");
    owed_.pop_front();
    lastHeard_ = owedSince_ = Clock::now();
    if (answer.has_ready()) ready_ = answer.ready();
    if (answer.has_warmed_up()) warm_ = !answer.warmed_up().more();
    return {};
}

Result<std::optional<WorkerProcess::Answer>> WorkerProcess::receive() {
    Answer answer;
    const auto received = channel_.receive(answer, milliseconds{0});
    if (!received) return received.error();
    if (!received->has_value()) return std::optional<Answer>{};
    if (auto settled = settle(answer); !settled) return std::move(settled).error();
    return std::optional{std::move(answer)};
}

Result<void> WorkerProcess::checkPicture(const internal::v1::Rendered& rendered,
                                         const RenderRequest& request) const {
    const bool asAsked = rendered.slot() == slot_ &&
                         static_cast<int>(rendered.width()) == request.size.x &&
                         static_cast<int>(rendered.height()) == request.size.y;
    if (!asAsked) return fail(ErrorCode::kInvalidArgument, "drew a picture nobody asked for");
    const Slot& slot = slots_[slot_];
    const std::size_t colourBytes = worker::slotBytes(request.size, false);
    if (colourBytes < 2 * slot.mark.size()) return {};
    const std::span<const std::byte> colours = slot.mapping.bytes.first(colourBytes);
    const bool written = !std::ranges::equal(slot.mark, colours.first(slot.mark.size())) &&
                         !std::ranges::equal(slot.mark, colours.last(slot.mark.size()));
    if (!written) return fail(ErrorCode::kInvalidArgument, "announced a picture and wrote none");
    return {};
}

Result<std::shared_ptr<const Picture>> WorkerProcess::copyPicture(
    const internal::v1::Rendered& rendered, const RenderRequest& request) const {
    const std::size_t needed = worker::slotBytes(request.size, request.wantFloat);
    const std::span<const std::byte> bytes = slots_[rendered.slot()].mapping.bytes;
    const std::size_t colourBytes = worker::slotBytes(request.size, false);
    try {
        auto picture = std::make_shared<Picture>();
        picture->size = request.size;
        const std::span<const std::byte> colours = bytes.first(colourBytes);
        picture->rgba8.assign(colours.begin(), colours.end());
        if (request.wantFloat) {
            const auto* floats = reinterpret_cast<const float*>(bytes.data() + colourBytes);
            picture->rgba32f.assign(floats, floats + colourBytes);
        }
        return std::shared_ptr<const Picture>{std::move(picture)};
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kLimitExceeded,
                    "no memory for a picture of " + std::to_string(needed) + " bytes");
    }
}

std::optional<WorkerProcess::Clock::time_point> WorkerProcess::deadline() const {
    if (owed_.empty()) return std::nullopt;
    return owedSince_ + owed_.front().limit;
}

std::string WorkerProcess::deadlineMissed() const {
    if (owed_.empty()) return {};
    const std::string limit = std::to_string(owed_.front().limit.count()) + " ms";
    switch (owed_.front().what) {
        case Owed::kReady: return "was not ready after " + limit;
        case Owed::kDataset: return "missed its deadline of " + limit + " for a dataset";
        case Owed::kFrame: return "missed its deadline of " + limit + " for a frame";
        case Owed::kPong: return "gave no sign of life for " + limit;
        case Owed::kMeasure: return "missed its deadline of " + limit + " for a measurement";
        case Owed::kPick: return "missed its deadline of " + limit + " for a pixel";
        case Owed::kWarmUp: return "missed its deadline of " + limit + " for building shaders";
    }
    return {};
}

}  // namespace volcast::workers
