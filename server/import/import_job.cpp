#include "server/import/import_job.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <new>
#include <sys/resource.h>
#include <utility>

#include "renderer/base/forbidden.h"
#include "renderer/base/sandbox.h"
#include "renderer/data/packed_dataset.h"
#include "server/import/import_fault.h"
#include "volcast/internal/v1/import.pb.h"

namespace volcast::import {

namespace {

using Clock = std::chrono::steady_clock;
namespace messages = volcast::internal::v1;
namespace fs = std::filesystem;

/// Address space that the program needs besides what it reads, for libraries and stacks: ours,
/// Python with VTK (0.2 GB), or OpenImageIO with what it links (0.9 GB).
std::uint64_t ownAddressSpace(const std::string& path) {
    constexpr std::uint64_t kMib = std::uint64_t{1} << 20;
    if (data::load::needsImages(path)) return 1536 * kMib;
    return (data::load::needsPython(path) ? 512 : 128) * kMib;
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Of this process and the reader it may have had; both were there at one time.
double peakMb() {
    rusage own{};
    rusage children{};
    ::getrusage(RUSAGE_SELF, &own);
    ::getrusage(RUSAGE_CHILDREN, &children);
    return static_cast<double>(own.ru_maxrss + children.ru_maxrss) / 1024.0;
}

/// Sends progress, but not more often than anybody can see.
class ProgressSender {
public:
    explicit ProgressSender(worker::Channel& channel) : channel_{channel} {}

    void operator()(const std::string& stage, double fraction) {
        constexpr double kPauseMs = 50.0;
        const auto now = Clock::now();
        if (stage == stage_ && millisecondsSince(last_) < kPauseMs) return;
        stage_ = stage;
        last_ = now;
        messages::FromImport message;
        message.mutable_progress()->set_stage(stage);
        message.mutable_progress()->set_fraction(std::clamp(fraction, 0.0, 1.0));
        // Whoever does not listen any more kills us; a lost progress message changes nothing.
        static_cast<void>(channel_.send(message));
    }

private:
    worker::Channel& channel_;
    std::string stage_;
    Clock::time_point last_;
};

base::SandboxPolicy policyFor(const data::load::Request& request,
                              std::vector<std::string> datasetPaths) {
    base::SandboxPolicy policy;
    policy.readable = std::move(datasetPaths);
    policy.maxFileBytes = request.maxMemoryBytes;
    policy.maxCpuSeconds = request.maxCpuSeconds;
    policy.maxAddressSpaceBytes = request.maxMemoryBytes + ownAddressSpace(request.path);
    if (!data::load::needsPython(request.path)) return policy;
    policy.mayExecute = true;  // Until its reader has started.
    for (const char* path :
         {"/usr", "/lib", "/lib64", "/bin", "/etc/ld.so.cache", "/etc/python3.11", "/etc/python3",
          "/etc/localtime", "/dev/null", "/dev/urandom", "/proc/self", "/proc/cpuinfo",
          "/proc/meminfo", "/sys/devices/system/cpu"}) {
        policy.readable.emplace_back(path);
    }
    return policy;
}

/// Keeps to the folder that the request has to lie below. A link may have been put into its path
/// since whoever asks has looked: what the sandbox of the dataset grants after this is taken from
/// within that folder alone, wherever its paths lead by then.
Result<void> stayBeneath(const data::load::Request& request) {
    std::error_code error;
    const fs::path folder = fs::canonical(request.beneath, error);
    if (error) return fail(ErrorCode::kIo, request.beneath + ": " + error.message());
    const fs::path real = fs::canonical(request.path, error);
    if (error) return fail(ErrorCode::kIo, request.path + ": " + error.message());
    if (std::ranges::mismatch(folder, real).in1 != folder.end()) {
        return fail(ErrorCode::kIo, request.path + ": leads out of " + request.beneath);
    }
    return base::enterSandbox(policyFor(request, {folder}));
}

struct Outcome {
    base::FileDescriptor packed;
    std::string format;
    std::vector<std::string> warnings;
};

Result<base::FileDescriptor> packed(const data::Dataset& dataset, ProgressSender& progress) {
    progress("pack", 0.0);
    return data::pack(dataset);
}

Result<base::FileDescriptor> buildAndPack(data::load::Loaded& loaded, ProgressSender& progress) {
    progress("build", 0.0);
    if (auto* mesh = std::get_if<data::MeshInput>(&loaded.input)) {
        auto built = data::buildMesh(std::move(*mesh));
        if (!built) return built.error();
        return packed(std::move(*built), progress);
    }
    const auto pyramid = [&progress](double share) { progress("pyramid", share); };
    if (auto* packer = std::get_if<data::VolumePacker>(&loaded.input)) {
        return packer->finish(pyramid);
    }
    auto built = data::buildVolume(std::move(std::get<data::VolumeInput>(loaded.input)), pyramid);
    if (!built) return built.error();
    return packed(std::move(*built), progress);
}

Result<Outcome> import(const data::load::Request& request, data::load::ImageReader readImages,
                       ProgressSender& progress, std::optional<worker::Fault> fault) {
    const auto paths = data::load::neededPaths(request.path);
    if (!paths) return paths.error();
    if (!request.beneath.empty() && !paths->empty()) {
        if (auto kept = stayBeneath(request); !kept) return kept.error();
    }
    auto sandboxed = base::enterSandbox(policyFor(request, *paths));
    if (!sandboxed) return sandboxed.error();
    if (fault) strike(*fault);
    const auto named = [&](const Error& error) {
        return fail(error.code, request.path + ": " + error.message, error.field);
    };
    auto loaded = data::load::load(
        request, [&](const std::string& stage, double fraction) { progress(stage, fraction); },
        readImages);
    if (!loaded) return loaded.error();
    auto file = buildAndPack(*loaded, progress);
    if (!file) return named(file.error());
    return Outcome{.packed = std::move(*file),
                   .format = std::move(loaded->format),
                   .warnings = std::move(loaded->warnings)};
}

/// The same, with the ends of memory and of the library's patience as errors.
Result<Outcome> importCatching(const data::load::Request& request,
                               data::load::ImageReader readImages, ProgressSender& progress,
                               std::optional<worker::Fault> fault) {
    try {
        return import(request, readImages, progress, fault);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kLimitExceeded, request.path + ": needs more memory than the " +
                                                   std::to_string(request.maxMemoryBytes >> 20) +
                                                   " MiB it may use");
    } catch (const std::exception& error) {
        return fail(ErrorCode::kInvalidArgument, request.path + ": " + error.what());
    }
}

}  // namespace

int tryForbidden(const data::load::Request& request) {
    const auto paths = data::load::neededPaths(request.path);
    const auto inside =
        paths ? base::enterSandbox(policyFor(request, *paths)) : Result<void>{paths.error()};
    if (!inside) {
        std::fprintf(stderr, "%s\n", inside.error().message.c_str());
        return 2;
    }
    const std::vector<base::Tried> all = base::tryForbidden("/tmp");
    std::fputs(base::report(all).c_str(), stdout);
    return base::allRefused(all) ? 0 : 1;
}

Result<void> runJob(const data::load::Request& request, data::load::ImageReader readImages,
                    worker::Channel& channel, std::optional<worker::Fault> fault) {
    const auto start = Clock::now();
    ProgressSender progress{channel};
    const auto outcome = importCatching(request, readImages, progress, fault);
    messages::FromImport message;
    if (!outcome) {
        message.mutable_refused()->set_code(static_cast<int>(outcome.error().code));
        message.mutable_refused()->set_message(outcome.error().message);
        return channel.send(message);
    }
    messages::Imported& imported = *message.mutable_imported();
    imported.set_format(outcome->format);
    for (const std::string& warning : outcome->warnings) imported.add_warnings(warning);
    imported.set_ms(millisecondsSince(start));
    imported.set_peak_mb(peakMb());
    return channel.send(message, {outcome->packed.get()});
}

}  // namespace volcast::import
