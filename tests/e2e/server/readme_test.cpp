// The session that protocol/README.md shows is played against a server without a folder.
#include <fstream>

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

std::vector<std::pair<char, json::value>> sessionOfReadme() {
    std::ifstream file{VOLCAST_SOURCE_DIR "/protocol/README.md"};
    std::vector<std::pair<char, json::value>> lines;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("```")) {
            inside = line == "```session";
        } else if (inside) {
            lines.emplace_back(line[0], json::parse(line.substr(2)));
        }
    }
    return lines;
}

TEST(Readme, TheSessionShownWorks) {
    const ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const auto client = WsClient::connect(server.port());
    ASSERT_TRUE(client);
    const auto session = sessionOfReadme();
    ASSERT_GT(session.size(), 10U);
    for (const auto& [who, shown] : session) {
        if (who == 'C') {
            client->sendText(json::serialize(shown));
            continue;
        }
        bool seen = false;
        while (!seen) {
            const auto message = client->receive(kPatience);
            ASSERT_TRUE(message.has_value()) << json::serialize(shown) << "\n" << server.log();
            if (message->text != (who == 'S')) continue;
            const auto* text = reinterpret_cast<const char*>(message->bytes.data());
            std::size_t begin = 0, length = message->bytes.size();
            if (who == 'F') {
                const auto prefix = protocol::decodePrefix(message->bytes);
                ASSERT_TRUE(prefix.has_value());
                begin = protocol::kPrefixBytes;
                length = prefix->headerBytes;
            }
            seen = contains(json::parse({text + begin, length}), shown);
        }
    }
}

}  // namespace
}  // namespace volcast::test
