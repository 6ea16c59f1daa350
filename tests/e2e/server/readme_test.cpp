// The session that protocol/README.md shows is played against a server without a folder.
#include <cctype>
#include <fstream>
#include <map>

#include <boost/json.hpp>
#include <gtest/gtest.h>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

namespace json = boost::json;

/// True where all that `shown` has is in `actual`, with the same value.
bool contains(const json::value& actual, const json::value& shown) {
    if (!shown.is_object()) return actual == shown;
    if (!actual.is_object()) return false;
    for (const auto& field : shown.get_object()) {
        const json::value* found = actual.get_object().if_contains(field.key());
        if (found == nullptr || !contains(*found, field.value())) return false;
    }
    return true;
}

using Lines = std::vector<std::pair<char, std::string>>;

std::vector<Lines> sessionsOfReadme() {
    std::ifstream file{VOLCAST_SOURCE_DIR "/protocol/README.md"};
    std::vector<Lines> sessions;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("```")) {
            inside = line == "```session";
            if (inside) sessions.emplace_back();
        } else if (inside) {
            sessions.back().emplace_back(line[0], line.substr(2));
        }
    }
    return sessions;
}

/// A message as JSON, and the letter that the README has for its kind.
std::pair<char, json::value> read(const WsMessage& message) {
    const auto* text = reinterpret_cast<const char*>(message.bytes.data());
    if (message.text) return {'S', json::parse({text, message.bytes.size()})};
    const auto prefix = protocol::decodePrefix(message.bytes);
    if (!prefix) return {'?', nullptr};
    return {'F', json::parse({text + protocol::kPrefixBytes, prefix->headerBytes})};
}

void play(const Lines& session, std::uint16_t port, const ServerProcess& server) {
    std::map<bool, std::unique_ptr<WsClient>> clients;  // The second one is in small letters.
    std::string link;
    for (auto [letter, shown] : session) {
        const bool second = std::islower(static_cast<unsigned char>(letter)) != 0;
        const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        auto& client = clients[second];
        if (!client) client = WsClient::connect(port);
        ASSERT_TRUE(client);
        if (const auto at = shown.find("$LINK"); at != std::string::npos) {
            shown.replace(at, 5, link);
        }
        if (kind == 'C') {
            client->sendText(shown);
            continue;
        }
        const json::value expected = json::parse(shown);
        bool seen = false;
        while (!seen) {
            const auto message = client->receive(kPatience);
            ASSERT_TRUE(message.has_value()) << shown << "\n" << server.log();
            const auto [is, value] = read(*message);
            seen = is == kind && contains(value, expected);
            if (!seen || !value.is_object() || !value.as_object().contains("viewShared")) continue;
            link = value.at("viewShared").at("link").as_string().c_str();
        }
    }
}

TEST(Readme, TheSessionsShownWork) {
    const ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const auto sessions = sessionsOfReadme();
    ASSERT_EQ(sessions.size(), 2U);
    for (const Lines& session : sessions) {
        ASSERT_GT(session.size(), 10U);
        play(session, server.port(), server);
    }
}

}  // namespace
}  // namespace volcast::test
