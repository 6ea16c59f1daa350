#include "server/commands/token_command.h"

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "server/session/link.h"

namespace volcast::commands {

namespace {

struct TokenSettings {
    std::string keyFile;
    v1::Role role = v1::ROLE_WATCH;
    std::int64_t hours = 24;
};

int printToken(const TokenSettings& settings) {
    const auto complain = [](const Error& error) {
        std::fprintf(stderr, "volcast token: %s\n", error.message.c_str());
        return 1;
    };
    const auto key = session::LinkKey::fromFile(settings.keyFile);
    if (!key) return complain(key.error());
    const auto expires = std::chrono::ceil<std::chrono::seconds>(std::chrono::system_clock::now()) +
                         std::chrono::hours{settings.hours};
    const auto token = session::signAccess({.role = settings.role, .expires = expires}, *key);
    if (!token) return complain(token.error());
    std::printf("%s\n", token->c_str());
    return 0;
}

}  // namespace

void addTokenCommand(CLI::App& app, int& exitCode) {
    auto settings = std::make_shared<TokenSettings>();
    CLI::App& command = *app.add_subcommand(
        "token", "Print an access token for servers that were started with --uploads-need-token");
    command
        .add_option(
            "--key-file", settings->keyFile,
            "The server's --link-key-file, or link.key in its --state-dir; made where there "
            "is none")
        ->required();
    command.add_option("--role", settings->role, "control: may upload; watch (default): may not")
        ->transform(
            CLI::CheckedTransformer(std::map<std::string, v1::Role>{{"watch", v1::ROLE_WATCH},
                                                                    {"control", v1::ROLE_CONTROL}},
                                    CLI::ignore_case));
    constexpr std::int64_t kMostHours = std::int64_t{366} * 24;
    command.add_option("--hours", settings->hours, "So long it is good")
        ->check(CLI::Range(std::int64_t{1}, kMostHours))
        ->capture_default_str();
    command.footer(
        "A page takes it from its address, SERVER/#access=TOKEN, a script sends it as\n"
        "Authorization: Bearer TOKEN. Whoever has it may use it until it expires; another key ends "
        "all.\nExit code: 0 printed, 1 the key cannot be read or made, 2 wrong options.");
    command.callback([settings, &exitCode] { exitCode = printToken(*settings); });
}

}  // namespace volcast::commands
