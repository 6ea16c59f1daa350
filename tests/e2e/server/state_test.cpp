// Views outlive the server that is killed, where it has a folder for them.
#include <csignal>
#include <fstream>

#include "tests/e2e/server/server_process.h"
#include "tests/e2e/server/test_client.h"

namespace volcast::test {
namespace {

TEST(State, ViewsOfAKilledServerComeBackWithLinksAndTokens) {
    const TemporaryFolder data, state;
    writeTetgenCube(data.path() / "good");
    writeFile(state.path() / "notes.txt", "not a view");
    const std::vector<std::string> arguments{data.path().string(), "--state-dir",
                                             state.path().string()};
    std::string token, link, id;
    std::vector<std::byte> before;
    {
        ServerProcess server{arguments};
        ASSERT_TRUE(server.ready()) << server.log();
        TestClient client{server.port()};
        token = client.waitForWelcome()->resume();
        client.openView(2, "good.node");
        id = client.waitForOpened(2)->id();
        link = client.share(2, v1::ROLE_WATCH);
        client.look(2, 7, 0.9);
        before = client.waitForLossless(2, 7)->payload;
        const auto file = state.path() / (id + ".view.json");
        ASSERT_TRUE(eventually([&] {
            std::ifstream in{file};
            const std::string text{std::istreambuf_iterator<char>{in}, {}};
            return text.find("\"input_seq\":7") != std::string::npos;
        })) << server.log();
        server.signal(SIGKILL);
        ASSERT_TRUE(server.wait().has_value());
    }
    writeFile(state.path() / "cut.view.json", "{\"volcast_view\":1,");
    const ServerProcess server{arguments};
    ASSERT_TRUE(server.ready()) << server.log();
    EXPECT_NE(server.log().find("cut.view.json"), std::string::npos) << "not named in the log";
    EXPECT_NE(server.log().find("notes.txt"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(state.path() / "cut.view.json"));
    v1::Hello hello;
    hello.set_resume(token);
    TestClient back{server.port(), TestClient::Form::kBinary, {}, hello};
    const auto opened = back.waitForOpened(2);
    ASSERT_TRUE(opened.has_value()) << server.log();
    EXPECT_EQ(opened->id(), id);
    EXPECT_EQ(opened->input_seq(), 7U);
    EXPECT_TRUE(opened->can_undo());
    const auto after = back.waitForLossless(2, 7);
    ASSERT_TRUE(after.has_value()) << server.log();
    EXPECT_EQ(after->payload, before);
    TestClient watcher{server.port()};
    watcher.join(link);
    const auto frame = watcher.waitForLossless(1, 7);
    ASSERT_TRUE(frame.has_value()) << server.log();
    EXPECT_EQ(frame->payload, before);
}

}  // namespace
}  // namespace volcast::test
