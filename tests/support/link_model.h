#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "server/session/pacing.h"

namespace volcast::test {

/// A way to a client and back: a queue without bound in front of a bottleneck, then distance.
struct Link {
    double bytesPerS = 1e6;
    double roundTripS = 0.05;  ///< Without any queue.
    double jitterS = 0.0;      ///< Up to so much more on the way there, order kept.
    std::function<double(double seconds)> share = {};  ///< Of bytesPerS at that time; empty: 1.
};

/// How the server fills it.
enum class Control { kNone, kOneCredit, kFull };

/// One frame as its client saw it.
struct ShownFrame {
    double shownAt = 0;  ///< Seconds since the start.
    double age = 0;      ///< Since it began to be drawn.
    session::PaceLevel level;
};

struct LinkRun {
    std::vector<ShownFrame> shown;
    std::vector<std::pair<double, std::string>> steps;  ///< When, and the reason in the header.
    std::size_t mostUnderWay = 0;
};

/// Bytes of a picture at a level, as JPEG of 1024 x 1024 and as VP9 took in the encoder benchmark's
/// proportions: JPEG 50 KB at quality 90.
inline std::size_t frameBytes(const session::PaceLevel& level) {
    const double ofQuality = std::pow(static_cast<double>(level.quality) / 90.0, 1.6);
    const double whole = (level.video ? 15e3 : 50e3) * ofQuality;
    return static_cast<std::size_t>(whole * level.scale * level.scale) + 300;
}

/// Steers a camera for `seconds` over `link`, with all times computed and none measured: a picture
/// takes `drawS` to draw and encode, a client that has it shows it after `showS` and acks it. Runs
/// in steps of 1 ms; the same input gives the same output.
inline LinkRun runLink(const Link& link, Control control, double seconds, double drawS = 1.0 / 30,
                       double showS = 0.004, bool video = false) {
    struct Flying {
        double at;
        std::uint32_t sequence;
        double drawnAt;
        session::PaceLevel level;
    };
    using session::TimePoint;
    const auto time = [](double s) {
        return TimePoint{} + std::chrono::hours{1} +
               std::chrono::microseconds{std::llround(s * 1e6)};
    };
    LinkRun run;
    session::Pacing pacing;
    pacing.allowVideo(video);
    std::mt19937 random{1};
    std::deque<Flying> there, back;
    // Pings go out each 5 s, behind what is on the wire, and weigh nothing.
    std::deque<std::pair<double, double>> pongs;  // When, and after how long.
    double path = 0;
    double drawnUntil = -1, beganAt = 0, wireFreeAt = 0, lastArrival = 0;
    session::PaceLevel drawing;
    std::uint32_t sequence = 0;
    std::string lastReason;
    for (int tick = 0; tick < static_cast<int>(seconds * 1000); ++tick) {
        const double now = tick * 1e-3;
        if (tick % 5000 == 0) {
            const double took = std::max(wireFreeAt - now, 0.0) + link.roundTripS;
            pongs.emplace_back(now + took, took);
        }
        while (!pongs.empty() && pongs.front().first <= now) {
            path = path == 0 ? pongs.front().second : std::min(path, pongs.front().second);
            pongs.pop_front();
        }
        while (!there.empty() && there.front().at <= now) {
            Flying frame = there.front();
            there.pop_front();
            run.shown.push_back({now + showS, now + showS - frame.drawnAt, frame.level});
            frame.at = now + showS + link.roundTripS / 2;
            back.push_back(frame);
        }
        while (!back.empty() && back.front().at <= now) {
            const std::chrono::microseconds hold{std::llround(showS * 1e6)};
            const std::chrono::microseconds ping{std::llround(path * 1e6)};
            pacing.acked({.sequence = back.front().sequence, .hold = hold, .path = ping},
                         time(now));
            back.pop_front();
        }
        pacing.forgiveSilence(time(now));
        if (const auto report = pacing.report(time(now)); report.reason != lastReason) {
            lastReason = report.reason;
            run.steps.emplace_back(now, lastReason);
        }
        if (drawnUntil >= 0 && now >= drawnUntil) {  // Handed to the socket.
            drawnUntil = -1;
            const std::size_t bytes = frameBytes(drawing);
            const double share = link.share ? link.share(now) : 1.0;
            wireFreeAt =
                std::max(wireFreeAt, now) + static_cast<double>(bytes) / (link.bytesPerS * share);
            const double jitter = link.jitterS * (static_cast<double>(random()) / 4294967296.0);
            lastArrival = std::max(lastArrival, wireFreeAt + link.roundTripS / 2 + jitter);
            there.push_back({lastArrival, ++sequence, beganAt, drawing});
            pacing.sent(sequence, bytes, time(now));
            run.mostUnderWay = std::max(run.mostUnderWay, pacing.flow().underWay());
        }
        if (drawnUntil >= 0) continue;
        const bool may = control == Control::kNone ||
                         (control == Control::kOneCredit
                              ? pacing.flow().underWay() == 0
                              : pacing.credit(0, time(now)) && time(now) >= pacing.nextStart());
        if (!may) continue;
        beganAt = now;
        drawnUntil = now + drawS;
        drawing = control == Control::kFull ? pacing.level() : session::PaceLevel{};
        pacing.started(time(now));
    }
    return run;
}

/// Of the frames shown from `fromS` on: the age that `share` of them do not exceed, in ms.
inline double ageMs(const LinkRun& run, double share, double fromS) {
    std::vector<double> ages;
    for (const ShownFrame& frame : run.shown) {
        if (frame.shownAt >= fromS) ages.push_back(frame.age * 1e3);
    }
    if (ages.empty()) return INFINITY;
    std::ranges::sort(ages);
    return ages[static_cast<std::size_t>(share * static_cast<double>(ages.size() - 1))];
}

inline double framesPerS(const LinkRun& run, double fromS, double untilS) {
    return static_cast<double>(std::ranges::count_if(
               run.shown,
               [=](const ShownFrame& f) { return f.shownAt >= fromS && f.shownAt < untilS; })) /
           (untilS - fromS);
}

}  // namespace volcast::test
