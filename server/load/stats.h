#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/load/histogram.h"
#include "server/load/process_tree.h"

namespace volcast::load {

/// What the clients of one kind saw. Connections and errors count from the start, all else in the
/// measured time.
struct Stats {
    unsigned clients = 0;
    bool moves = false;  ///< They send inputs all the time.
    std::uint64_t connects = 0;
    std::uint64_t failedConnects = 0;
    std::uint64_t lostConnections = 0;
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;  ///< Of frames, headers included.
    std::uint64_t inputs = 0;
    std::uint64_t overtaken = 0;  ///< Inputs whose state was never shown, but a newer one.
    Histogram inputToFrame;       ///< Each input, to the first frame of it or a newer one.
    Histogram age;                ///< Each new state, from its input to this client.
    Histogram firstFrame;         ///< From connecting.
    std::map<std::string, std::uint64_t> errors;
    std::vector<std::uint64_t> framesByClient;
};

/// What a run yielded.
struct Outcome {
    double seconds = 0;  ///< Measured.
    unsigned views = 0;
    std::map<std::string, Stats> kinds;  ///< By name; those that watch apart.
    bool interrupted = false;
    bool serverMeasured = false;
    TreeUse before, after;  ///< The measured time's ends.
    TreeUse most;           ///< Largest of each, sampled once a second.
};

}  // namespace volcast::load
