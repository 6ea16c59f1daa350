#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boost/json.hpp>

#include "renderer/accuracy/measurement.h"

namespace volcast::commands {

/// One way to draw one layer, and what it is worth.
struct AccuracyRow {
    std::string model = {}, layer = {}, integrator = {}, evaluator = {};  ///< As in the registry.
    std::string sampling = {};                                            ///< Of voxels.
    double step = 0.0;  ///< Of voxels, in smallest spacings; 0: as the options say.
    std::optional<accuracy::Measurement> measured = {};
    std::string refusal = {};  ///< Why nothing was measured.
    bool onFront = false;
};

/// What all rows of a run have in common.
struct AccuracyRun {
    std::string command;  ///< That repeats it.
    std::string data;
    std::uint64_t cells = 0;
    std::string unit = "cells";  ///< What they are.
    scene::PictureSize size{0};
    int frames = 0;
    std::string gl;
    std::vector<AccuracyRow> rows;
};

/// What the reference took for all rows; empty where there is none.
std::string referenceLineOf(const AccuracyRun& run);

/// The error that plots and fronts go by: RMS in linear light, silhouettes included.
double errorOf(const AccuracyRow& row);

/// Marks the rows of each model and layer that no other row of it beats: none has at most this
/// error in less time, or a smaller error in at most this time.
void markFronts(std::vector<AccuracyRow>& rows);

/// An aligned table for people; a `*` marks the fronts.
std::string tableOf(const AccuracyRun& run);
boost::json::object jsonOf(const AccuracyRun& run);

}  // namespace volcast::commands
