#include "server/commands/warnings_only.h"

#include <memory>
#include <utility>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace volcast::commands {

void logWarningsOnly(const std::string& command) {
    auto log = std::make_shared<spdlog::logger>("volcast",
                                                std::make_shared<spdlog::sinks::stderr_sink_mt>());
    log->set_level(spdlog::level::warn);
    log->set_pattern(command + ": %v");
    spdlog::set_default_logger(std::move(log));
}

}  // namespace volcast::commands
