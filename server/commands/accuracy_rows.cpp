#include "server/commands/accuracy_rows.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "renderer/worker/frame_message.h"

namespace volcast::commands {

namespace {

namespace json = boost::json;

using Cells = std::vector<std::string>;

std::string text(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

std::string percent(double share) {
    return text(share > 0.0 && share < 1e-4 ? "%.1e%%" : "%.2f%%", 100.0 * share);
}

accuracy::ReferenceEffort effortOf(const AccuracyRun& run) {
    accuracy::ReferenceEffort sum;
    for (const AccuracyRow& row : run.rows) {
        if (!row.measured) continue;
        sum.rays += row.measured->reference.rays;
        sum.raySeconds += row.measured->reference.raySeconds;
        sum.treeSeconds += row.measured->reference.treeSeconds;
    }
    return sum;
}

double microsecondsARay(const accuracy::ReferenceEffort& effort) {
    return 1e6 * effort.raySeconds / static_cast<double>(effort.rays);
}

bool beats(const AccuracyRow& a, const AccuracyRow& b) {
    const bool noWorse = errorOf(a) <= errorOf(b) && a.measured->medianMs <= b.measured->medianMs;
    const bool better = errorOf(a) < errorOf(b) || a.measured->medianMs < b.measured->medianMs;
    return noWorse && better;
}

/// What brings rays and data together.
std::string wayOf(const AccuracyRow& row) {
    if (row.sampling.empty()) return row.evaluator;
    return row.sampling + (row.step > 0.0 ? text(", step %g", row.step) : std::string{});
}

Cells cellsOf(const AccuracyRow& row, const AccuracyRun& run) {
    Cells cells{row.onFront ? "*" : "", row.model, row.integrator, wayOf(row)};
    if (!row.measured) return cells;
    const accuracy::Measurement& m = *row.measured;
    for (const double error : {m.all.max, m.all.rms}) cells.push_back(text("%.2e", error));
    cells.push_back(percent(m.all.share255));
    cells.push_back(percent(m.all.share65535));
    cells.push_back(text("%.2e", m.inner.max));
    cells.push_back(text("%.2e", m.inner.rms));
    cells.push_back(percent(m.inner.share255));
    for (const double ms : {m.medianMs, m.minMs, m.maxMs}) cells.push_back(text("%.2f", ms));
    cells.push_back(text("%.1f", m.cellsPerRay));
    const double pixels = static_cast<double>(run.size.x) * run.size.y;
    cells.push_back(m.walkSteps == 0 ? ""
                                     : text("%.1f", static_cast<double>(m.walkSteps) / pixels));
    cells.push_back(m.cellsDrawn == 0 ? "" : std::to_string(m.cellsDrawn));
    return cells;
}

/// Numbers to the right; the first `left` columns to the left.
std::string align(const std::vector<Cells>& table, std::size_t left) {
    std::vector<std::size_t> widths;
    for (const Cells& line : table) {
        widths.resize(std::max(widths.size(), line.size()));
        for (std::size_t i = 0; i < line.size(); ++i) {
            widths[i] = std::max(widths[i], line[i].size());
        }
    }
    std::string out;
    for (const Cells& line : table) {
        std::string row;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string padding(widths[i] - line[i].size(), ' ');
            row += (i == 0 ? "" : "  ") + (i < left ? line[i] + padding : padding + line[i]);
        }
        out += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
}

json::object jsonOf(const accuracy::Errors& errors) {
    return {{"pixels", errors.pixels},
            {"max", errors.max},
            {"rms", errors.rms},
            {"share_over_1_255", errors.share255},
            {"share_over_1_65535", errors.share65535}};
}

json::object jsonOf(const AccuracyRow& row) {
    json::object object{{"model", row.model},
                        {"layer", row.layer},
                        {"integrator", row.integrator},
                        {"evaluator", row.evaluator}};
    if (!row.sampling.empty()) object["sampling"] = row.sampling;
    if (row.step > 0.0) object["step_spacings"] = row.step;
    if (!row.measured) {
        object["refusal"] = row.refusal;
        return object;
    }
    const accuracy::Measurement& m = *row.measured;
    object["drawn_by"] = worker::name(m.evaluator);
    object["error"] = jsonOf(m.all);
    object["error_without_silhouettes"] = jsonOf(m.inner);
    object["median_ms"] = m.medianMs;
    object["min_ms"] = m.minMs;
    object["max_ms"] = m.maxMs;
    object["cells_per_ray"] = m.cellsPerRay;
    if (m.walkSteps != 0) object["walk_steps"] = m.walkSteps;
    if (m.cellsDrawn != 0) object["cells_drawn"] = m.cellsDrawn;
    object["on_front"] = row.onFront;
    return object;
}

}  // namespace

std::string referenceLineOf(const AccuracyRun& run) {
    const accuracy::ReferenceEffort effort = effortOf(run);
    if (effort.rays == 0) return {};
    return "reference: " + text("%.1f", microsecondsARay(effort)) + " us of CPU time a ray (" +
           std::to_string(effort.rays) + " rays), its tree of boxes " +
           text("%.1f", 1e3 * effort.treeSeconds) + " ms\n";
}

double errorOf(const AccuracyRow& row) {
    return row.measured->all.rms;
}

void markFronts(std::vector<AccuracyRow>& rows) {
    for (AccuracyRow& row : rows) {
        row.onFront = row.measured.has_value() &&
                      std::ranges::none_of(rows, [&row](const AccuracyRow& other) {
                          return other.measured.has_value() && other.model == row.model &&
                                 other.layer == row.layer && other.sampling == row.sampling &&
                                 beats(other, row);
                      });
    }
}

std::string tableOf(const AccuracyRun& run) {
    std::vector<Cells> table{
        {"", "", "", "", "all", "pixels", "", "", "without", "silhouettes", "", "ms", "", "",
         "cells", "steps", "cells"},
        {"", "model", "integrator", "evaluator", "max", "rms", ">1/255", ">1/65535", "max", "rms",
         ">1/255", "median", "min", "max", "per ray", "per ray", "drawn"}};
    for (const AccuracyRow& row : run.rows) table.push_back(cellsOf(row, run));
    std::string out = align(table, 4);
    for (const AccuracyRow& row : run.rows) {
        if (row.measured) continue;
        out += row.model + " " + row.integrator + " " + wayOf(row) + ": " + row.refusal + "\n";
    }
    return out;
}

json::object jsonOf(const AccuracyRun& run) {
    json::array rows;
    for (const AccuracyRow& row : run.rows) rows.push_back(jsonOf(row));
    json::object all{{"command", run.command}, {"data", run.data},
                     {run.unit, run.cells},    {"size", {run.size.x, run.size.y}},
                     {"frames", run.frames},   {"gl", run.gl},
                     {"rows", std::move(rows)}};
    const accuracy::ReferenceEffort effort = effortOf(run);
    if (effort.rays > 0) {
        all["reference"] = {{"rays", effort.rays},
                            {"us_per_ray", microsecondsARay(effort)},
                            {"tree_ms", 1e3 * effort.treeSeconds}};
    }
    return all;
}

}  // namespace volcast::commands
