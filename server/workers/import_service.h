#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/data/moments.h"
#include "renderer/worker/fault_names.h"

namespace volcast::workers {

struct ImportRequest {
    std::string path;  ///< File or folder; "demo:mesh" and "demo:volume" are built in.
    std::string tetgenSwitches = "pq1.414";  ///< For surfaces and point sets.
    glm::dvec3 spacing{0.0};                 ///< For image stacks, which do not say it; 0: 1.
    std::string series;                      ///< Which time steps or array, reserved; empty: all.
};

struct ImportSettings {
    std::string importPath;  ///< Empty: `volcast-import` beside this program.
    std::chrono::milliseconds deadline{120'000};
    std::uint64_t maxMemoryBytes = std::uint64_t{8} << 30;
    std::string beneath = {};  ///< Nothing outside of this folder is read; empty: any path may be.
    /// Asked once for each import, on its thread: how it is to fail. Empty: no import is.
    std::function<std::optional<worker::FaultSpec>()> fault = {};
};

struct ImportedDataset {
    base::FileDescriptor packed;  ///< Sealed; unpack() has accepted it.
    data::DatasetSummary summary;
    std::vector<data::Moments> moments;  ///< Of each of its fields.
    std::string format;
    std::vector<std::string> warnings;
    double ms = 0, peakMb = 0;
};

/// Runs one sandboxed import process to its end; blocks (call it from a thread of your own).
///
/// Errors: what the importer refused, with file and reason; kTimeout past the deadline;
/// kLimitExceeded out of memory; kIo where the process died (with its signal).
Result<ImportedDataset> runImport(
    const ImportRequest& request, const ImportSettings& settings,
    const std::function<void(const std::string& stage, double fraction)>& progress);

/// True for names that some loader takes, such as "bluntfin.vtu"; a catalogue lists these.
/// Companion files (.ele of a .node, .raw of a .mhd) are not.
bool isImportable(const std::string& path);

}  // namespace volcast::workers
