#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boost/json.hpp>

#include "server/load/settings.h"
#include "server/load/stats.h"

namespace volcast::load {

/// What a run must keep to; absent: anything goes.
struct Thresholds {
    // Of input to frame, over all clients that steer.
    std::optional<double> maxP50Ms = {}, maxP95Ms = {}, maxP99Ms = {};
    std::optional<double> maxAgeP99Ms = {};  ///< Of all clients.
    std::optional<double> maxAgeMs = {};     ///< The oldest of all.
    std::optional<double> minFps = {};       ///< Of the slowest client in a view that moves.
    std::optional<double> minFairness = {};  ///< Slowest over fastest view that moves, in frames/s.
    std::optional<double> maxErrors = {};
    // Of the own server's processes.
    std::optional<double> maxServerMb = {};     ///< Resident, together.
    std::optional<double> maxServerCores = {};  ///< Of the server itself, without its workers.
    // From the measured time's begin to its end, workers included.
    std::optional<double> maxGrowthMb = {}, maxGrowthDescriptors = {}, maxGrowthThreads = {};
};

/// One sentence for each threshold that was not kept.
std::vector<std::string> violations(const Outcome& outcome, const Thresholds& thresholds);

/// A table for people.
std::string reportText(const LoadSettings& settings, const Outcome& outcome);
/// The same and more for programs; times in ms, memory in bytes.
boost::json::object reportJson(const LoadSettings& settings, const Outcome& outcome,
                               const std::vector<std::string>& violated);

}  // namespace volcast::load
