#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/load/histogram.h"
#include "server/load/process_tree.h"

namespace volcast::load {

/// What the clients of one kind saw. Connections and errors count from the start, all else in the
/// measured time.
struct Stats {
    unsigned clients = 0;
    std::uint64_t connects = 0;
    std::uint64_t failedConnects = 0;
    std::uint64_t lostConnections = 0;
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;  ///< Of frames, headers included.
    // The smallest and poorest frames, in what the server paces by; none where none says.
    std::optional<double> leastScale = {};
    std::optional<std::uint32_t> leastQuality = {};  ///< Of JPEG.
    std::uint64_t inputs = 0;
    std::uint64_t overtaken = 0;  ///< Inputs of the view whose state never came, but a newer one.
    Histogram inputToFrame;       ///< Each input, to the first frame of it or a newer one.
    Histogram age;                ///< Each new state, from its input to this client.
    // What came neither until the connection ended nor until the run did: the time so far.
    Histogram unanswered;  ///< As inputToFrame.
    Histogram unseen;      ///< As age: at most since this client last saw a new state.
    Histogram firstFrame;  ///< From connecting.
    std::map<std::string, std::uint64_t> errors;
    std::vector<std::uint64_t> framesByClient;
};

/// What a run yielded.
struct Outcome {
    double seconds = 0;  ///< Measured.
    unsigned views = 0;
    std::map<std::string, Stats> kinds;  ///< By name; those that watch apart.
    // Of the views in which somebody moves all the time.
    std::vector<std::uint64_t> steeredFrames;  ///< Of who steers, by view.
    std::vector<std::uint64_t> movingFrames;   ///< Of each client that stays.
    bool interrupted = false;
    bool serverMeasured = false;
    TreeUse before, after;  ///< The measured time's ends.
    TreeUse most;           ///< Largest of each but CPU, sampled once a second.
};

}  // namespace volcast::load
