#include "renderer/worker/options.h"

#include <charconv>
#include <string_view>

namespace volcast::worker {

const char* const kHelp =
    "volcast-worker owns one GL context and draws what volcast asks for; volcast starts it.\n"
    "  --gpu DEVICE          EGL device: index, file or `software`; none: surfaceless\n"
    "  --cache-dir FOLDER    the driver's shader cache\n"
    "  --shader-dir FOLDER   shader chunks instead of the embedded ones\n"
    "  --volume-budget BYTES a channel of voxels that takes more is drawn from bricks\n"
    "  --probe               print what EGL and GL offer as JSON\n"
    "  --fault NAME[:AFTER]  fail once, for tests, after so many chances\n"
    "  --list-faults         print those names\n"
    "  --try-forbidden       try what the sandbox is to refuse, and print what became of it\n";

Result<Options> parseOptions(std::span<char* const> arguments) {
    Options options;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string_view name = arguments[i];
        bool* flag = name == "--probe"           ? &options.probe
                     : name == "--list-faults"   ? &options.listFaults
                     : name == "--try-forbidden" ? &options.tryForbidden
                     : name == "--help"          ? &options.help
                                                 : nullptr;
        if (flag != nullptr) {
            *flag = true;
            continue;
        }
        std::string budget;
        std::string fault;
        std::string* value = name == "--gpu"             ? &options.gpu
                             : name == "--cache-dir"     ? &options.cacheFolder
                             : name == "--shader-dir"    ? &options.shaderFolder
                             : name == "--volume-budget" ? &budget
                             : name == "--fault"         ? &fault
                                                         : nullptr;
        if (value == nullptr) {
            return fail(ErrorCode::kInvalidArgument, std::string{name} + ": unknown argument");
        }
        if (++i == arguments.size()) {
            return fail(ErrorCode::kInvalidArgument, std::string{name} + ": its value is missing");
        }
        *value = arguments[i];
        if (value == &fault) {
            const auto spec = parseFault(fault);
            if (!spec) return fail(spec.error().code, "--fault: " + spec.error().message);
            options.fault = *spec;
        }
        if (value != &budget) continue;
        const char* end = budget.data() + budget.size();
        const auto read = std::from_chars(budget.data(), end, options.volumeBudgetBytes);
        if (read.ec != std::errc{} || read.ptr != end) {
            return fail(ErrorCode::kInvalidArgument,
                        std::string{name} + ": " + budget + " is no number of bytes");
        }
    }
    return options;
}

}  // namespace volcast::worker
