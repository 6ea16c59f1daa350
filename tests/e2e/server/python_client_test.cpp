// The example client in Python, as its README says.
#include <fstream>

#include <gmock/gmock.h>

#include "server/workers/child_process.h"
#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

constexpr const char* kClient = VOLCAST_SOURCE_DIR "/tests/load/client.py";

int runClient(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), kClient);
    auto child = workers::ChildProcess::spawn(
        {.program = "/usr/bin/python3",
         .arguments = arguments,
         .environment = workers::inheritedEnvironment({"PATH=", "HOME="})});
    EXPECT_TRUE(child.has_value());
    const auto status = child->reap();
    return status.signalled ? -1 : status.value;
}

std::string textOf(const std::filesystem::path& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

class PythonClient : public SharedServer {};

TEST_F(PythonClient, OrbitsAndSavesTheFinalPicture) {
    const TemporaryFolder place;
    const std::string file = place.path() / "final.png";
    const std::string url = "ws://127.0.0.1:" + std::to_string(port()) + "/v1/ws";
    ASSERT_EQ(runClient({url, "--dataset", "good.node", "--steps", "5", "--width", "64", "--height",
                         "48", "--output", file}),
              0);
    const std::string bytes = textOf(file);
    TestFrame frame;
    frame.header.set_codec(v1::CODEC_PNG);
    const auto raw = std::as_bytes(std::span{bytes});
    frame.payload.assign(raw.begin(), raw.end());
    const Decoded picture = decode(frame);
    EXPECT_EQ(picture.width, 64);
    EXPECT_EQ(picture.height, 48);
    // Something was drawn: not all pixels are the same.
    EXPECT_THAT(picture.pixels, testing::Contains(testing::Ne(picture.pixels.front())));
}

TEST_F(PythonClient, SaysWhatTheServerRefused) {
    const std::string url = "ws://127.0.0.1:" + std::to_string(port()) + "/v1/ws";
    EXPECT_EQ(runClient({url, "--dataset", "none"}), 1);
    EXPECT_EQ(runClient({"ws://127.0.0.1:1/v1/ws"}), 1);
}

TEST(PythonClientSource, HasAtMostAHundredLines) {
    const std::string text = textOf(kClient);
    const auto lines = std::ranges::count(text, '\n');
    EXPECT_GT(lines, 0);
    EXPECT_LE(lines, 100);
}

}  // namespace
}  // namespace volcast::test
