#include "server/metrics/metrics.h"

#include <array>
#include <map>
#include <mutex>

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

namespace volcast::metrics {

namespace {

using prometheus::Counter;
using prometheus::Gauge;
using prometheus::Histogram;

constexpr double kSecond = 1000.0;  ///< ms

const Histogram::BucketBoundaries& seconds() {
    static const Histogram::BucketBoundaries bounds{0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05,
                                                    0.1,    0.2,   0.5,   1.0,   2.0,  5.0};
    return bounds;
}

/// "CODEC_JPEG" -> "jpeg".
std::string codecLabel(v1::Codec codec) {
    std::string label = v1::Codec_Name(codec).substr(std::string{"CODEC_"}.size());
    for (char& c : label) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return label;
}

/// Counters of ours only grow: what another part counts is caught up with.
void catchUp(Counter& counter, std::uint64_t value) {
    const double behind = static_cast<double>(value) - counter.Value();
    if (behind > 0) counter.Increment(behind);
}

}  // namespace

struct Metrics::Parts {
    prometheus::Registry registry;
    std::mutex standing;  ///< Of two who ask at once.

    Counter& counter(const char* name, const char* help, const prometheus::Labels& labels = {}) {
        return prometheus::BuildCounter().Name(name).Help(help).Register(registry).Add(labels);
    }
    Gauge& gauge(const char* name, const char* help, const prometheus::Labels& labels = {}) {
        return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add(labels);
    }
    Histogram& stage(const char* label) {
        return prometheus::BuildHistogram()
            .Name("volcast_frame_stage_seconds")
            .Help("Time of a sent frame in one stage; draw and earlier only where it was drawn")
            .Register(registry)
            .Add({{"stage", label}}, seconds());
    }

    Gauge& connections = gauge("volcast_connections", "WebSockets that are open");
    Counter& connects = counter("volcast_connections_total", "WebSockets that were opened");
    Counter& receivedBytes = counter("volcast_received_bytes_total", "Payload of messages read");
    Counter& receivedMessages = counter("volcast_received_messages_total", "Messages read");
    Counter& sentBytes = counter("volcast_sent_bytes_total", "Payload of messages written");
    Histogram& wait = stage("wait");
    Histogram& upload = stage("upload");
    Histogram& draw = stage("draw");
    Histogram& readback = stage("readback");
    Histogram& encode = stage("encode");
    Histogram& queue = stage("queue");
    Histogram& roundTrip = prometheus::BuildHistogram()
                               .Name("volcast_ack_round_trip_seconds")
                               .Help(
                                   "Frame handed to the socket until its ack, less what the "
                                   "client held it; smoothed by view")
                               .Register(registry)
                               .Add({}, seconds());
    Histogram& underWay = prometheus::BuildHistogram()
                              .Name("volcast_frames_under_way")
                              .Help("Credits in use: frames of a view under way, with the one sent")
                              .Register(registry)
                              .Add({}, Histogram::BucketBoundaries{1, 2, 3, 4, 6, 8});
    std::map<v1::Codec, Counter*> frames, frameBytes;
    std::map<v1::ErrorCode, Counter*> errors;
    Gauge& views = gauge("volcast_views", "Views that are open");
    Gauge& queueDepth(const char* of) {
        return gauge("volcast_queue_depth", "What waits for a thread, or for a GL worker",
                     {{"queue", of}});
    }
    Gauge& renderQueue = queueDepth("render");
    Gauge& encodeQueue = queueDepth("encode");
    Gauge& importQueue = queueDepth("import");
    Counter& imports = counter("volcast_imports_total", "Imports that ended", {{"result", "good"}});
    Counter& failedImports =
        counter("volcast_imports_total", "Imports that ended", {{"result", "failed"}});
    Counter& workerStarts = counter("volcast_worker_starts_total", "GL workers that were started");
    Counter& workerLosses =
        counter("volcast_worker_losses_total", "GL workers that were ready and were lost");
    Gauge& workerReady = gauge("volcast_worker_ready", "1: there is one", {{"worker", "drawing"}});
    Gauge& spareReady = gauge("volcast_worker_ready", "1: there is one", {{"worker", "spare"}});

    Parts() {
        for (int code = v1::ErrorCode_MIN; code <= v1::ErrorCode_MAX; ++code) {
            if (!v1::ErrorCode_IsValid(code)) continue;
            const auto one = static_cast<v1::ErrorCode>(code);
            errors[one] = &counter("volcast_errors_total", "Error messages to clients",
                                   {{"code", v1::ErrorCode_Name(one)}});
        }
        for (int codec = v1::Codec_MIN; codec <= v1::Codec_MAX; ++codec) {
            if (!v1::Codec_IsValid(codec) || codec == v1::CODEC_UNSPECIFIED) continue;
            const auto one = static_cast<v1::Codec>(codec);
            const prometheus::Labels labels{{"codec", codecLabel(one)}};
            frames[one] = &counter("volcast_frames_total", "Frames sent", labels);
            frameBytes[one] =
                &counter("volcast_frame_bytes_total", "Encoded pictures sent", labels);
        }
    }
};

Metrics::Metrics() : parts_{std::make_unique<Parts>()} {}
Metrics::Metrics(Metrics&&) noexcept = default;
Metrics& Metrics::operator=(Metrics&&) noexcept = default;
Metrics::~Metrics() = default;

void Metrics::connected() {
    parts_->connections.Increment();
    parts_->connects.Increment();
}

void Metrics::disconnected() {
    parts_->connections.Decrement();
}

void Metrics::received(std::size_t bytes) {
    parts_->receivedMessages.Increment();
    parts_->receivedBytes.Increment(static_cast<double>(bytes));
}

void Metrics::sent(std::size_t bytes) {
    parts_->sentBytes.Increment(static_cast<double>(bytes));
}

void Metrics::refused(v1::ErrorCode code) {
    const auto found = parts_->errors.find(code);
    if (found != parts_->errors.end()) found->second->Increment();
}

void Metrics::frameSent(const v1::FrameHeader& header, std::size_t payloadBytes,
                        std::size_t underWay) {
    const v1::Timings& times = header.timings();
    if (header.redrawn()) {
        parts_->wait.Observe(times.wait_ms() / kSecond);
        parts_->upload.Observe(times.upload_ms() / kSecond);
        parts_->draw.Observe(times.draw_ms() / kSecond);
        parts_->readback.Observe(times.readback_ms() / kSecond);
    }
    parts_->encode.Observe(times.encode_ms() / kSecond);
    parts_->queue.Observe(times.queue_ms() / kSecond);
    parts_->underWay.Observe(static_cast<double>(underWay));
    const auto frames = parts_->frames.find(header.codec());
    if (frames == parts_->frames.end()) return;
    frames->second->Increment();
    parts_->frameBytes.at(header.codec())->Increment(static_cast<double>(payloadBytes));
}

void Metrics::frameAcked(double roundTripMs) {
    parts_->roundTrip.Observe(roundTripMs / kSecond);
}

std::string Metrics::text(const Standing& standing) {
    const std::lock_guard lock{parts_->standing};
    parts_->views.Set(static_cast<double>(standing.views));
    parts_->renderQueue.Set(static_cast<double>(standing.viewsToDraw));
    parts_->encodeQueue.Set(static_cast<double>(standing.picturesToEncode));
    parts_->importQueue.Set(static_cast<double>(standing.importsWaiting));
    catchUp(parts_->imports, standing.imports);
    catchUp(parts_->failedImports, standing.failedImports);
    catchUp(parts_->workerStarts, standing.workerStarts);
    catchUp(parts_->workerLosses, standing.workerLosses);
    parts_->workerReady.Set(standing.workerReady ? 1 : 0);
    parts_->spareReady.Set(standing.spareReady ? 1 : 0);
    return prometheus::TextSerializer{}.Serialize(parts_->registry.Collect());
}

}  // namespace volcast::metrics
