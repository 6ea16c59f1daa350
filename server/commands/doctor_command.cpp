#include "server/commands/doctor_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <boost/json.hpp>
#include <spdlog/spdlog.h>

#include "server/commands/findings.h"
#include "server/commands/json_text.h"

namespace volcast::commands {

namespace {

namespace json = boost::json;

struct DoctorOptions {
    bool asJson = false;
    std::string gpu;
};

void print(const std::vector<Finding>& findings) {
    std::string group;
    for (const Finding& finding : findings) {
        if (finding.group != group) std::printf("%s\n", finding.group.c_str());
        group = finding.group;
        std::printf("  %-7s %-26s %s\n", finding.ok ? "ok" : "missing", finding.name.c_str(),
                    finding.detail.c_str());
        if (!finding.ok) {
            std::printf("  %-7s %-26s %s: %s\n", "", "", finding.required ? "required" : "costs",
                        finding.cost.c_str());
        }
    }
}

json::object asJson(const std::vector<Finding>& findings, bool canServe) {
    json::array entries;
    for (const Finding& finding : findings) {
        json::object entry{{"group", finding.group},
                           {"name", finding.name},
                           {"state", finding.ok ? "ok" : "missing"},
                           {"required", finding.required},
                           {"detail", finding.detail}};
        if (!finding.ok) entry["cost"] = finding.cost;
        entries.push_back(std::move(entry));
    }
    return {{"can_serve", canServe}, {"findings", std::move(entries)}};
}

int run(const DoctorOptions& options) {
    spdlog::set_level(spdlog::level::off);  // All there is to say is in the findings.
    std::vector<Finding> findings = findGraphics(options.gpu);
    for (const auto& more : {findCodecs(), findImportFormats(), findSandbox()}) {
        findings.insert(findings.end(), more.begin(), more.end());
    }
    const bool canServe = std::ranges::none_of(
        findings, [](const Finding& finding) { return finding.required && !finding.ok; });
    if (options.asJson) {
        std::printf("%s\n", jsonText(asJson(findings, canServe)).c_str());
    } else {
        print(findings);
        std::printf("%s\n", canServe ? "Volcast can serve here."
                                     : "Volcast cannot serve here: see what is required above.");
    }
    return canServe ? 0 : 1;
}

}  // namespace

void addDoctorCommand(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<DoctorOptions>();
    CLI::App* command =
        app.add_subcommand("doctor", "Says what was found here, and what a missing part costs");
    command->footer("Exit code: 0 where the service can run, else 1; 2 for wrong options.");
    command->add_flag("--json", options->asJson, "One line of JSON instead of text");
    command->add_option("--gpu", options->gpu, "EGL device to look at; none: surfaceless")
        ->envname("VOLCAST_GPU");
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace volcast::commands
