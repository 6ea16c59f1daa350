#include "renderer/worker/options.h"

#include <charconv>
#include <string_view>

namespace volcast::worker {

Result<Options> parseOptions(std::span<char* const> arguments) {
    Options options;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string_view name = arguments[i];
        if (name == "--probe") {
            options.probe = true;
            continue;
        }
        std::string budget;
        std::string* value = name == "--gpu"             ? &options.gpu
                             : name == "--cache-dir"     ? &options.cacheFolder
                             : name == "--shader-dir"    ? &options.shaderFolder
                             : name == "--volume-budget" ? &budget
                                                         : nullptr;
        if (value == nullptr) {
            return fail(ErrorCode::kInvalidArgument, std::string{name} + ": unknown argument");
        }
        if (++i == arguments.size()) {
            return fail(ErrorCode::kInvalidArgument, std::string{name} + ": its value is missing");
        }
        *value = arguments[i];
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
