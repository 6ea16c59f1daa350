#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "volcast/v1/error.pb.h"
#include "volcast/v1/frame.pb.h"

namespace volcast::metrics {

/// What is read when somebody asks, because other parts count it anyway.
struct Standing {
    std::size_t views = 0;
    std::size_t viewsToDraw = 0;       ///< That wait for their turn of a GL worker.
    std::size_t picturesToEncode = 0;  ///< That wait for an encoder's thread.
    std::size_t importsWaiting = 0;
    std::uint64_t imports = 0, failedImports = 0;      ///< Since the start.
    std::uint64_t workerStarts = 0, workerLosses = 0;  ///< Since the start.
    bool workerReady = false, spareReady = false;
};

/// The numbers of one server, in the words of Prometheus. The one home of its library.
///
/// All methods from any thread. Labels are enumerators of ours, so their number is bounded.
class Metrics {
public:
    Metrics();
    Metrics(Metrics&&) noexcept;
    Metrics& operator=(Metrics&&) noexcept;
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;
    ~Metrics();

    void connected();
    void disconnected();
    void received(std::size_t bytes);  ///< Of one message, without WebSocket's own.
    void sent(std::size_t bytes);
    void refused(v1::ErrorCode code);
    /// A frame goes out: its stages, its codec, and how many of its view are under way with it.
    void frameSent(const v1::FrameHeader& header, std::size_t payloadBytes, std::size_t underWay);
    /// One was acknowledged; `roundTripMs` without the time that the client held it.
    void frameAcked(double roundTripMs);

    /// The text exposition format 0.0.4.
    std::string text(const Standing& standing);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace volcast::metrics
