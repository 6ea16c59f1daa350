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
    std::optional<double> maxP50Ms, maxP95Ms, maxP99Ms;
    std::optional<double> maxAgeP99Ms;  ///< Of all clients.
    std::optional<double> minFps;       ///< Of the slowest client that moves.
    std::optional<double> maxErrors;
    std::optional<double> maxServerMb;  ///< Resident, of the own server's processes together.
};

/// One sentence for each threshold that was not kept.
std::vector<std::string> violations(const Outcome& outcome, const Thresholds& thresholds);

/// A table for people.
std::string reportText(const LoadSettings& settings, const Outcome& outcome);
/// The same and more for programs; times in ms, memory in bytes.
boost::json::object reportJson(const LoadSettings& settings, const Outcome& outcome,
                               const std::vector<std::string>& violated);

}  // namespace volcast::load
