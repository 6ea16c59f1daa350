#include "server/workers/import_service.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <optional>
#include <unistd.h>
#include <utility>

#include "renderer/base/memfd.h"
#include "renderer/data/load/formats.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/worker/channel.h"
#include "server/workers/child_process.h"
#include "volcast/internal/v1/import.pb.h"

namespace volcast::workers {

namespace {

using Clock = std::chrono::steady_clock;
namespace messages = volcast::internal::v1;
namespace fs = std::filesystem;

/// What the importer said last: the data or a refusal.
struct LastWord {
    messages::FromImport message;
    base::FileDescriptor packed;
};

/// All digits: a spacing may be tiny.
std::string number(double value) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

/// What all processors together can do until the deadline: an import that goes on past it, for
/// nobody, ends of itself, and none is ended before.
std::uint64_t cpuSeconds(const ImportSettings& settings) {
    const auto deadline = std::chrono::ceil<std::chrono::seconds>(settings.deadline).count();
    const long processors = std::max(::sysconf(_SC_NPROCESSORS_CONF), 1L);
    return static_cast<std::uint64_t>(std::max(deadline, decltype(deadline){1})) *
               static_cast<std::uint64_t>(processors) +
           1;
}

SpawnDesc spawnDesc(const ImportRequest& request, const ImportSettings& settings, int channel) {
    return {.program = settings.importPath.empty() ? besideThisProgram("volcast-import")
                                                   : settings.importPath,
            .arguments = {"--tetgen-switches=" + request.tetgenSwitches, "--spacing",
                          number(request.spacing.x), number(request.spacing.y),
                          number(request.spacing.z),
                          "--max-memory=" + std::to_string(settings.maxMemoryBytes),
                          "--max-cpu=" + std::to_string(cpuSeconds(settings)), "--", request.path},
            .environment = inheritedEnvironment({"ASAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS"}),
            .channel = channel};
}

/// Ends the importer and the reader it may have started: they are one process group.
void killGroup(const ChildProcess& child) {
    if (child.pid() > 0) ::kill(-child.pid(), SIGKILL);  // Not reaped yet: the id is still ours.
}

Error timedOut(const ImportRequest& request, const ImportSettings& settings) {
    return fail(ErrorCode::kTimeout, request.path + ": import took longer than " +
                                         std::to_string(settings.deadline.count()) + " ms");
}

/// An importer that says nothing more has died.
Error died(const ImportRequest& request, ChildProcess& child) {
    killGroup(child);
    return fail(ErrorCode::kIo, request.path + ": the import process ended without a result (" +
                                    child.reap().text() + ")");
}

/// Listens until the last word, the end of the process or the deadline.
Result<LastWord> listen(worker::Channel& channel, ChildProcess& child, const ImportRequest& request,
                        const ImportSettings& settings,
                        const std::function<void(const std::string&, double)>& progress) {
    const auto until = Clock::now() + settings.deadline;
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
        LastWord word;
        auto got = channel.receive(word.message, std::max(left, std::chrono::milliseconds{0}));
        if (!got) {
            if (got.error().code == ErrorCode::kDeviceLost) return died(request, child);
            return fail(got.error().code, request.path + ": " + got.error().message);
        }
        if (!got->has_value() || left.count() <= 0) return timedOut(request, settings);
        if (word.message.has_progress()) {
            if (progress) {
                progress(word.message.progress().stage(), word.message.progress().fraction());
            }
            continue;
        }
        if (!(*got)->empty()) word.packed = std::move((*got)->front());
        return word;
    }
}

/// An importer that a file took over may send anything: nothing is believed before unpack() has.
Result<ImportedDataset> accept(LastWord word, const ImportRequest& request) {
    if (word.message.has_refused()) {
        const int code = word.message.refused().code();
        const bool known = code >= 0 && code <= static_cast<int>(ErrorCode::kTimeout);
        return fail(known ? static_cast<ErrorCode>(code) : ErrorCode::kIo,
                    word.message.refused().message());
    }
    if (!word.message.has_imported() || !word.packed.valid()) {
        return fail(ErrorCode::kIo, request.path + ": the import process sent no data");
    }
    if (!base::isSealedReadOnly(word.packed)) {
        return fail(ErrorCode::kIo, request.path +
                                        ": the import process sent data that it could "
                                        "still change");
    }
    const auto dataset = data::unpack(word.packed);
    if (!dataset) {
        return fail(dataset.error().code, request.path + ": " + dataset.error().message);
    }
    const messages::Imported& imported = word.message.imported();
    data::DatasetSummary summary = data::summarize(*dataset);
    std::vector<std::string> warnings{imported.warnings().begin(), imported.warnings().end()};
    for (std::string& warning : data::warningsOf(summary)) warnings.push_back(std::move(warning));
    return ImportedDataset{.packed = std::move(word.packed),
                           .summary = std::move(summary),
                           .moments = data::momentsOf(*dataset),
                           .format = imported.format(),
                           .warnings = std::move(warnings),
                           .ms = imported.ms(),
                           .peakMb = imported.peak_mb()};
}

/// The number that a name ends with, before its suffix, and what stands around it.
struct SeriesName {
    std::string before;
    std::string digits;
    std::string after;
};

std::optional<SeriesName> seriesName(const fs::path& path) {
    const std::string stem = path.stem().string();
    const std::size_t last = stem.find_last_of("0123456789");
    if (last == std::string::npos) return std::nullopt;
    const std::size_t before = stem.find_last_not_of("0123456789", last);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    return SeriesName{stem.substr(0, first), stem.substr(first, last + 1 - first),
                      stem.substr(last + 1) + path.extension().string()};
}

/// True where a picture of the same series with a smaller number lies beside `path`.
bool hasPredecessor(const fs::path& path) {
    const auto name = seriesName(path);
    constexpr std::size_t kMaxDigits = 9;
    if (!name || name->digits.size() > kMaxDigits) return false;
    const int number = std::stoi(name->digits);
    if (number == 0) return false;
    std::string previous = std::to_string(number - 1);
    std::error_code ignored;
    const auto there = [&](const std::string& digits) {
        return fs::exists(path.parent_path() / (name->before + digits + name->after), ignored);
    };
    if (there(previous)) return true;
    if (previous.size() < name->digits.size()) {
        previous.insert(0, name->digits.size() - previous.size(), '0');
    }
    return there(previous);
}

bool holdsPictures(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        const data::load::Format* format = data::load::formatOf(at->path().string());
        if (format != nullptr && format->family == data::load::Family::kImages) return true;
    }
    return false;
}

}  // namespace

Result<ImportedDataset> runImport(
    const ImportRequest& request, const ImportSettings& settings,
    const std::function<void(const std::string& stage, double fraction)>& progress) {
    auto pair = worker::Channel::createPair();
    if (!pair) return pair.error();
    SpawnDesc desc = spawnDesc(request, settings, pair->theirs.get());
    if (const auto fault = settings.fault ? settings.fault() : std::nullopt) {
        desc.arguments.insert(desc.arguments.begin(), "--fault=" + worker::toText(*fault));
    }
    if (!settings.beneath.empty()) {
        desc.arguments.insert(desc.arguments.begin(), "--beneath=" + settings.beneath);
    }
    auto child = ChildProcess::spawn(desc);
    if (!child) return child.error();
    pair->theirs = {};  // Else its end would not be noticed.
    auto word = listen(pair->ours, *child, request, settings, progress);
    killGroup(*child);
    child->reap();
    if (!word) return word.error();
    return accept(std::move(*word), request);
}

bool isImportable(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return holdsPictures(path);
    const data::load::Format* format = data::load::formatOf(path);
    if (format == nullptr) return false;
    return format->family != data::load::Family::kImages || !hasPredecessor(path);
}

}  // namespace volcast::workers
