#include "renderer/worker/fault_names.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace volcast::worker {

namespace {

struct Row {
    Fault fault;
    FaultyProcess process;
    const char* name;
    const char* what;
};

// In the order of the enumerators.
constexpr std::array kRows{
    Row{Fault::kCrash, FaultyProcess::kWorker, "crash", "a draw call of GL ends in SIGSEGV"},
    Row{Fault::kHangInDraw, FaultyProcess::kWorker, "hang-in-draw",
        "a draw call of GL never returns"},
    Row{Fault::kHangInCompile, FaultyProcess::kWorker, "hang-in-compile",
        "linking a GL program never returns"},
    Row{Fault::kGpuReset, FaultyProcess::kWorker, "gpu-reset", "GL reports that it was reset"},
    Row{Fault::kOutOfGpuMemory, FaultyProcess::kWorker, "out-of-gpu-memory",
        "GL refuses memory for a buffer"},
    Row{Fault::kUnwrittenSlot, FaultyProcess::kWorker, "unwritten-slot",
        "a picture is announced and its pixels are not written"},
    Row{Fault::kWrongSize, FaultyProcess::kWorker, "wrong-size",
        "a picture is announced with a size that nobody asked for"},
    Row{Fault::kGarbage, FaultyProcess::kWorker, "garbage",
        "an answer is replaced by bytes that are no message"},
    Row{Fault::kExitInUpload, FaultyProcess::kWorker, "exit-in-upload",
        "the worker exits while it fills a GL buffer"},
    Row{Fault::kSpareExit, FaultyProcess::kSpare, "spare-exit",
        "the spare exits while it builds shaders or waits"},
    Row{Fault::kLoseGpu, FaultyProcess::kWorker, "lose-gpu",
        "the worker calls its device a GPU and loses it, at its start or after AFTER pictures; "
        "with --gpu software it does not"},
    Row{Fault::kImportCrash, FaultyProcess::kImport, "import-crash", "an import ends in SIGSEGV"},
    Row{Fault::kImportHang, FaultyProcess::kImport, "import-hang", "an import never ends"},
};

const Row& rowOf(Fault fault) {
    return kRows[static_cast<std::size_t>(fault)];
}

std::string names() {
    std::string text;
    for (const Row& row : kRows) text += (text.empty() ? "" : ", ") + std::string{row.name};
    return text;
}

}  // namespace

Result<FaultSpec> parseFault(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::string name{text.substr(0, colon)};
    const auto row = std::ranges::find_if(kRows, [&](const Row& one) { return one.name == name; });
    if (row == kRows.end()) {
        return fail(ErrorCode::kInvalidArgument,
                    "\"" + name + "\" is no fault; there are " + names());
    }
    FaultSpec spec{.fault = row->fault};
    if (colon == std::string_view::npos) return spec;
    const std::string_view after = text.substr(colon + 1);
    const auto read = std::from_chars(after.data(), after.data() + after.size(), spec.after);
    if (read.ec != std::errc{} || read.ptr != after.data() + after.size()) {
        return fail(ErrorCode::kInvalidArgument,
                    name + ": \"" + std::string{after} + "\" is no number of chances to let pass");
    }
    return spec;
}

std::string toText(const FaultSpec& spec) {
    return std::string{rowOf(spec.fault).name} + ":" + std::to_string(spec.after);
}

FaultyProcess struckBy(Fault fault) noexcept {
    return rowOf(fault).process;
}

std::string faultList() {
    std::string text;
    for (const Row& row : kRows) {
        std::string name = row.name;
        name.resize(20, ' ');
        text += name + row.what + "\n";
    }
    return text;
}

}  // namespace volcast::worker
