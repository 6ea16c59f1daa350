// Behind a proxy of the same machine that ends TLS, as deploy/README.md says.
#include <csignal>
#include <fstream>
#include <memory>

#include <boost/json.hpp>
#include <gtest/gtest.h>

#include "tests/e2e/server/shared_server.h"
#include "tests/e2e/server/shell.h"

namespace volcast::test {
namespace {

constexpr const char* kPageOrigin = "https://volcast.example";

/// A program whose lines are read one by one; it is waited for at the end.
class Program {
public:
    Program(const std::string& command, const char* mode) : pipe_{::popen(command.c_str(), mode)} {}
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    Program(Program&&) = delete;
    Program& operator=(Program&&) = delete;
    ~Program() { ::pclose(pipe_); }
    std::string line() {
        std::array<char, 4096> buffer{};
        const bool any = std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe_);
        return any ? buffer.data() : "";
    }

private:
    FILE* pipe_;
};

/// A server and the proxy in front of it.
class BehindProxy : public testing::Test {
protected:
    void SetUp() override {
        makeCertificate(folder_.path());
        ASSERT_TRUE(server_.ready()) << server_.log();
        // The proxy's port comes by a file: its input is what keeps it alive.
        const std::string port = file("port");
        proxy_ = std::make_unique<Program>("/usr/bin/python3 " VOLCAST_SOURCE_DIR
                                           "/tests/support/tls_proxy.py " +
                                               file("cert.pem") + " " + file("key.pem") + " " +
                                               std::to_string(server_.port()) + " >" + port,
                                           "w");
        ASSERT_TRUE(eventually([&] { return std::ifstream{port} >> port_ && port_ != 0; }));
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder_.path() / name; }
    /// A web page's client: says hello, prints "welcome", then the code it was closed with.
    [[nodiscard]] std::string page(const std::string& origin) const {
        return "/usr/bin/python3 -c '"
               "import asyncio, json, ssl, websockets\n"
               "async def talk():\n"
               "    context = ssl.create_default_context(cafile=\"" +
               file("cert.pem") +
               "\")\n"
               "    async with websockets.connect(\"wss://127.0.0.1:" +
               std::to_string(port_) + "/v1/ws\", ssl=context, origin=\"" + origin +
               "\", subprotocols=[\"volcast.v1\"], compression=None) as socket:\n"
               "        await socket.send(json.dumps({\"hello\": {\"major\": 1}}))\n"
               "        print(list(json.loads(await socket.recv()))[0], flush=True)\n"
               "        try:\n"
               "            while True: await socket.recv()\n"
               "        except websockets.ConnectionClosed as end:\n"
               "            print(end.code, flush=True)\n"
               "try:\n"
               "    asyncio.run(asyncio.wait_for(talk(), 60))\n"
               "except websockets.InvalidStatusCode as refused:\n"
               "    print(refused.status_code)\n'";
    }

    TemporaryFolder folder_;
    ServerProcess server_{{"--allow-origin", kPageOrigin}};
    std::unique_ptr<Program> proxy_;
    int port_ = 0;
};

TEST_F(BehindProxy, FramesComeOverWss) {
    const auto ran =
        runVolcast({"load", "wss://127.0.0.1:" + std::to_string(port_), "--trust", file("cert.pem"),
                    "--clients", "orbit=2,idle", "--views", "1", "--duration", "1", "--width", "64",
                    "--height", "48", "--max-errors", "0", "--json"});
    ASSERT_TRUE(ran.has_value());
    ASSERT_EQ(ran->exitCode, 0) << ran->err;
    const auto report = boost::json::parse(ran->out);
    EXPECT_GT(report.at("kinds").at("orbit").at("frames").to_number<int>(), 0);
}

TEST_F(BehindProxy, PagesOfTheProxysOriginAreLetInAndNoOthers) {
    Program stranger{page("https://elsewhere.example"), "r"};
    EXPECT_EQ(stranger.line(), "403\n");
    Program own{page(kPageOrigin), "r"};
    EXPECT_EQ(own.line(), "welcome\n");
    server_.signal(SIGTERM);
    EXPECT_EQ(own.line(), "1012\n");
    const auto ended = server_.wait();
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 0) << ended->err;
}

}  // namespace
}  // namespace volcast::test
