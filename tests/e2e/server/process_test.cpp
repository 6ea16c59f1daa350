// Starting, refusing to start, and ending; files and health over HTTP.
#include <csignal>
#include <unistd.h>

#include <gmock/gmock.h>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

class Http : public SharedServer {};

TEST_F(Http, HealthAndReadiness) {
    EXPECT_EQ(http(port(), "/healthz").status, 200U);
    const HttpReply ready = http(port(), "/readyz");
    EXPECT_EQ(ready.status, 200U);
    EXPECT_EQ(ready.headers.at("content-type"), "application/json");
    const auto json = readiness();
    EXPECT_TRUE(json.at("ready").as_bool());
    EXPECT_GE(json.at("generation").to_number<double>(), 1);
    EXPECT_FALSE(json.at("gl_renderer").as_string().empty());
}

TEST_F(Http, MethodsPathsAndHeadersAreChecked) {
    EXPECT_EQ(http(port(), "/healthz", "HEAD").status, 200U);
    EXPECT_EQ(http(port(), "/healthz", "HEAD").body, "");
    EXPECT_EQ(http(port(), "/healthz", "HEAD").headers.at("content-length"), "3");
    const HttpReply posted = http(port(), "/", "POST", "Content-Length: 0\r\n");
    EXPECT_EQ(posted.status, 405U);
    EXPECT_EQ(posted.headers.at("allow"), "GET, HEAD");
    EXPECT_EQ(http(port(), "/nothing").status, 404U);
    EXPECT_EQ(http(port(), "/%00").status, 400U);
    EXPECT_EQ(http(port(), "/v1/ws").status, 426U);
    EXPECT_EQ(http(port(), "/", "GET", "X: " + std::string(9000, 'x') + "\r\n").status, 431U);
}

// A header that never ends costs its connection after 5 s, not a thread.
TEST_F(Http, ASlowHeaderIsCutOff) {
    const HttpReply reply = rawHttp(port(), "GET / HTTP/1.1\r\nHost: x\r\n");
    EXPECT_EQ(reply.status, 0U);
}

TEST_F(Http, AnswersCarrySecurityHeaders) {
    const HttpReply reply = http(port(), "/healthz");
    EXPECT_THAT(reply.headers.at("content-security-policy"), HasSubstr("default-src 'none'"));
    EXPECT_EQ(reply.headers.at("x-content-type-options"), "nosniff");
}

TEST_F(Http, WebPagesOfOtherOriginsAndOtherProtocolsAreRefused) {
    const std::vector<std::pair<WsOptions, unsigned>> rows{
        {{.origin = "http://evil.example"}, 403},
        {{.origin = "http://127.0.0.1:" + std::to_string(port())}, 101},
        {{.subprotocol = ""}, 400},
        {{.subprotocol = "chat"}, 400},
        {{.subprotocol = "chat, volcast.v1"}, 101},
        {{.target = "/elsewhere"}, 404},
    };
    for (const auto& [options, expected] : rows) {
        unsigned status = 0;
        (void)WsClient::connect(port(), options, &status);
        EXPECT_EQ(status, expected) << options.origin << options.subprotocol << options.target;
    }
}

TEST(Files, TheClientIsServedFromItsFolderAndNothingElseIs) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "secret.txt", "secret");
    writeFile(folder.path() / "client/index.html", "<!doctype html>hello");
    writeFile(folder.path() / "client/assets/app-12ab.js", "1;");
    std::filesystem::create_symlink("../secret.txt", folder.path() / "client/link.txt");
    const ServerProcess server{{"--client-dir", (folder.path() / "client").string()}};
    ASSERT_TRUE(server.ready()) << server.log();
    const HttpReply index = http(server.port(), "/");
    EXPECT_EQ(index.status, 200U);
    EXPECT_EQ(index.body, "<!doctype html>hello");
    EXPECT_EQ(index.headers.at("cache-control"), "no-cache");
    const std::string etag = index.headers.at("etag");
    EXPECT_EQ(http(server.port(), "/", "GET", "If-None-Match: " + etag + "\r\n").status, 304U);
    const HttpReply script = http(server.port(), "/assets/app-12ab.js");
    EXPECT_EQ(script.headers.at("content-type"), "text/javascript; charset=utf-8");
    EXPECT_THAT(script.headers.at("cache-control"), HasSubstr("immutable"));
    for (const char* target :
         {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt",
          "/link.txt", "//secret.txt", "/assets"}) {
        const HttpReply reply = http(server.port(), target);
        EXPECT_EQ(reply.status, 404U) << target;
        EXPECT_THAT(reply.body, testing::Not(HasSubstr("secret\n"))) << target;
    }
}

// What goes over the wire is what a browser asks for; a cache between knows that there are two.
TEST(Files, TextIsSentCompressedToThoseWhoTakeGzip) {
    const TemporaryFolder folder;
    const std::string page = "<!doctype html>" + std::string(20'000, 'x');
    writeFile(folder.path() / "index.html", page);
    const ServerProcess server{{"--client-dir", folder.path().string()}};
    ASSERT_TRUE(server.ready()) << server.log();
    const HttpReply packed = http(server.port(), "/", "GET", "Accept-Encoding: br, gzip\r\n");
    EXPECT_EQ(packed.status, 200U);
    EXPECT_EQ(packed.headers.at("content-encoding"), "gzip");
    EXPECT_EQ(packed.headers.at("vary"), "Accept-Encoding");
    EXPECT_EQ(packed.headers.at("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(packed.headers.at("content-length"), std::to_string(packed.body.size()));
    EXPECT_LT(packed.body.size(), 200U);
    EXPECT_EQ(packed.body.substr(0, 2), "\x1f\x8b");
    for (const char* accepts : {"", "Accept-Encoding: gzip;q=0\r\n"}) {
        const HttpReply plain = http(server.port(), "/", "GET", accepts);
        EXPECT_EQ(plain.body, page);
        EXPECT_EQ(plain.headers.count("content-encoding"), 0U);
        EXPECT_EQ(plain.headers.at("vary"), "Accept-Encoding");
        EXPECT_NE(plain.headers.at("etag"), packed.headers.at("etag"));
    }
    const std::string known = "Accept-Encoding: gzip\r\nIf-None-Match: W/\"other\", " +
                              packed.headers.at("etag") + "\r\n";
    const HttpReply same = http(server.port(), "/", "GET", known);
    EXPECT_EQ(same.status, 304U);
    EXPECT_EQ(same.body, "");
    EXPECT_EQ(same.headers.at("vary"), "Accept-Encoding");
    const HttpReply head = http(server.port(), "/", "HEAD", "Accept-Encoding: gzip\r\n");
    EXPECT_EQ(head.headers.at("content-length"), packed.headers.at("content-length"));
    EXPECT_EQ(head.body, "");
}

TEST(Start, AClientThatIsNotBuiltIsSaidPlainly) {
    const ServerProcess server{{"--client-dir", "/nonexistent"}};
    ASSERT_TRUE(server.ready()) << server.log();
    const HttpReply reply = http(server.port(), "/");
    EXPECT_EQ(reply.status, 503U);
    EXPECT_THAT(reply.body, HasSubstr("not built"));
}

TEST(Start, ATakenPortIsNamed) {
    const ServerProcess first;
    ASSERT_TRUE(first.ready()) << first.log();
    const auto second = runVolcast({"serve", "--port", std::to_string(first.port())});
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->exitCode, 1);
    EXPECT_EQ(second->out, "");
    EXPECT_THAT(second->err, HasSubstr(std::to_string(first.port())));
    EXPECT_THAT(second->err, HasSubstr("in use"));
}

TEST(Start, WrongArgumentsAreNamed) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "file", "x");
    const std::string missing = (folder.path() / "missing").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> rows{
        {{"serve", "--port", "0", missing}, missing},
        {{"serve", "--port", "0", (folder.path() / "file").string()}, "file"},
        {{"serve", "--port", "0", "--host", "not.an.address"}, "not.an.address"},
        {{"serve", "--port", "0", "--gpu", "no-such-device"}, "no-such-device"},
    };
    for (const auto& [arguments, named] : rows) {
        const auto ended = runVolcast(arguments);
        ASSERT_TRUE(ended.has_value());
        EXPECT_EQ(ended->exitCode, 1) << named;
        EXPECT_THAT(ended->err, HasSubstr(named));
        EXPECT_EQ(ended->out, "");
    }
    EXPECT_NE(runVolcast({"serve", "--port", "70000"})->exitCode, 0);
    EXPECT_NE(runVolcast({"serve", "--nonsense"})->exitCode, 0);
}

TEST(Start, AFolderThatMayNotBeReadIsNamed) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read every folder";
    const TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::none);
    const auto ended = runVolcast({"serve", "--port", "0", folder.path().string()});
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 1);
    EXPECT_THAT(ended->err, HasSubstr("Permission denied"));
}

// The vendor library that this names does not exist, so no display can be had.
TEST(Start, NoEglIsSaidPlainly) {
    const auto ended = runVolcast({"serve", "--port", "0"},
                                  {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent/egl.json"});
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 1);
    EXPECT_EQ(ended->out, "");
    EXPECT_THAT(ended->err, HasSubstr("EGL"));
}

TEST(Start, ClientsBeyondTheLimitAreTurnedAway) {
    const ServerProcess server{{"--max-clients", "2"}};
    ASSERT_TRUE(server.ready()) << server.log();
    const TestClient one{server.port()};
    {
        const TestClient two{server.port()};
        ASSERT_TRUE(one.ok() && two.ok());
        unsigned status = 0;
        EXPECT_FALSE(WsClient::connect(server.port(), {}, &status));
        EXPECT_EQ(status, 503U);
    }
    EXPECT_TRUE(eventually([&] { return WsClient::connect(server.port()) != nullptr; }));
}

TEST(End, ClientsAreToldAndTheProcessEndsCleanly) {
    for (const int number : {SIGTERM, SIGINT}) {
        ServerProcess server;
        ASSERT_TRUE(server.ready()) << server.log();
        TestClient client{server.port()};
        ASSERT_TRUE(client.ok());
        client.openView(1, "demo:volume");
        ASSERT_TRUE(client.waitForFrame(1, 1).has_value()) << server.log();
        server.signal(number);
        while (client.read(kPatience)) {
        }
        EXPECT_EQ(client.socket().closeCode(), 1012);
        const auto ended = server.wait();
        ASSERT_TRUE(ended.has_value());
        EXPECT_EQ(ended->exitCode, 0) << ended->err;
    }
}

// The client does not read, so it cannot answer the close: the second signal does not wait for it.
TEST(End, ASecondSignalEndsTheProcessAtOnce) {
    ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const auto client = WsClient::connect(server.port());
    ASSERT_TRUE(client);
    server.signal(SIGTERM);
    ASSERT_TRUE(eventually([&] { return server.log().find("draining") != std::string::npos; }));
    server.signal(SIGTERM);
    const auto ended = server.wait();
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 128 + SIGTERM);
}

}  // namespace
}  // namespace volcast::test
