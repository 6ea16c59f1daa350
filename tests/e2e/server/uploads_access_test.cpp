// Who may upload where the server asks for access tokens.
#include <fstream>

#include <gmock/gmock.h>

#include "server/session/link.h"
#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

using std::chrono::hours;
using testing::HasSubstr;

class UploadsAccess : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        std::filesystem::create_directory(folder->path() / "data");
        writeTetgenCube(folder->path() / "data" / "own");
        process = std::make_unique<ServerProcess>(std::vector<std::string>{
            (folder->path() / "data").string(), "--allow-uploads", "--uploads-need-token",
            "--upload-keep-free-mb", "1", "--link-key-file", keyFile()});
    }
    static void TearDownTestSuite() {
        process.reset();
        folder.reset();
    }
    void SetUp() override { ASSERT_TRUE(process->ready()) << process->log(); }
    static std::string keyFile() { return (folder->path() / "link.key").string(); }
    static std::uint16_t port() { return process->port(); }
    /// As `volcast token` prints it for the server's key.
    static std::string token(const std::string& role) {
        const auto ended =
            runVolcast({"token", "--key-file", keyFile(), "--role", role, "--hours", "1"});
        if (!ended || ended->exitCode != 0) return {};
        return ended->out.substr(0, ended->out.find('\n'));
    }
    static std::string signedUntil(std::chrono::system_clock::time_point expires) {
        const auto key = session::LinkKey::fromFile(keyFile());
        return *session::signAccess({.role = v1::ROLE_CONTROL, .expires = expires}, *key);
    }
    /// A file, then its end: all requests of an upload need the token.
    static std::array<HttpReply, 3> upload(const std::string& access) {
        const std::string path = "/v1/uploads/0123456789abcdef";
        const std::string header =
            access.empty() ? std::string{} : "Authorization: Bearer " + access + "\r\n";
        return {http(port(), path + "/a.vtu", "PUT", header + "Content-Length: 1\r\n\r\nx"),
                http(port(), path + "?name=a", "POST", header),
                http(port(), path, "DELETE", header)};
    }
    static std::optional<v1::Welcome> welcomed(TestClient& client) {
        return client.ok() ? client.waitForWelcome() : std::nullopt;
    }
    static v1::Hello helloWith(const std::string& access) {
        v1::Hello hello;
        hello.set_access(access);
        return hello;
    }
    static void expectRefused(const std::string& access, unsigned status, const std::string& why) {
        for (const HttpReply& reply : upload(access)) {
            EXPECT_EQ(reply.status, status) << reply.body;
            EXPECT_THAT(reply.body, HasSubstr(why));
            EXPECT_EQ(reply.headers.contains("www-authenticate"), status == 401U);
        }
        EXPECT_FALSE(std::filesystem::exists(folder->path() / "data/uploads/.0123456789abcdef"));
    }
    static std::unique_ptr<TemporaryFolder> folder;
    static std::unique_ptr<ServerProcess> process;
};
std::unique_ptr<TemporaryFolder> UploadsAccess::folder;
std::unique_ptr<ServerProcess> UploadsAccess::process;

TEST_F(UploadsAccess, ATokenToControlUploads) {
    const std::string access = token("control");
    ASSERT_FALSE(access.empty());
    const auto replies = upload(access);
    EXPECT_EQ(replies[0].status, 201U) << replies[0].body;
    EXPECT_EQ(replies[1].status, 201U) << replies[1].body;
    EXPECT_EQ(replies[2].status, 404U) << "finished, so that nothing is left to cancel";
    TestClient client{port(), TestClient::Form::kBinary, {}, helloWith(access)};
    const auto welcome = welcomed(client);
    ASSERT_TRUE(welcome.has_value());
    EXPECT_TRUE(welcome->has_uploads());
}

TEST_F(UploadsAccess, ATokenToWatchDoesNot) {
    const std::string access = token("watch");
    ASSERT_FALSE(access.empty());
    expectRefused(access, 403, "allows to watch");
    TestClient client{port(), TestClient::Form::kBinary, {}, helloWith(access)};
    const auto welcome = welcomed(client);
    ASSERT_TRUE(welcome.has_value());
    EXPECT_FALSE(welcome->has_uploads());
}

TEST_F(UploadsAccess, NobodyElseDoes) {
    expectRefused("", 401, "need an access token");
    TestClient client{port()};
    const auto welcome = welcomed(client);
    ASSERT_TRUE(welcome.has_value());
    EXPECT_FALSE(welcome->has_uploads());
    // All else is as it was.
    client.openView(1, "own.node");
    EXPECT_TRUE(client.waitForFrame(1, 1).has_value()) << process->log();
}

TEST_F(UploadsAccess, ForgedAndExpiredTokensAreNone) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    std::string forged = token("watch");
    ASSERT_GT(forged.size(), 4U);
    forged[2] = forged[2] == 'I' ? 'J' : 'I';  // Bits of the role.
    const std::string ofAnotherKey = *session::signAccess(
        {.role = v1::ROLE_CONTROL, .expires = now + hours{1}}, *session::LinkKey::random());
    for (const std::string& access : {forged, ofAnotherKey, std::string{"x"}}) {
        expectRefused(access, 401, "not made by this server");
    }
    EXPECT_EQ(upload(signedUntil(now + hours{1}))[0].status, 201U) << "the key is the server's";
    EXPECT_EQ(upload(signedUntil(now + hours{1}))[2].status, 200U);
    expectRefused(signedUntil(now), 401, "has expired");
    TestClient client{port(), TestClient::Form::kBinary, {}, helloWith(signedUntil(now))};
    const auto error = client.waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_EQ(error->field(), "hello.access");
    const auto welcome = welcomed(client);
    ASSERT_TRUE(welcome.has_value()) << "the client goes on without it";
    EXPECT_FALSE(welcome->has_uploads());
}

TEST_F(UploadsAccess, ALinkToAViewIsNoToken) {
    TestClient owner{port()};
    ASSERT_TRUE(owner.ok());
    owner.openView(1, "own.node");
    ASSERT_TRUE(owner.waitForOpened().has_value());
    for (const v1::Role role : {v1::ROLE_WATCH, v1::ROLE_CONTROL}) {
        const std::string link = owner.share(1, role);
        ASSERT_FALSE(link.empty());
        expectRefused(link, 401, "not made by this server");
    }
}

TEST(UploadsAccessOff, WithoutAKeyThatIsKeptNoTokenCouldBeMade) {
    const TemporaryFolder folder;
    const auto ended = runVolcast({"serve", folder.path().string(), "--port", "0",
                                   "--allow-uploads", "--uploads-need-token"});
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 1);
    EXPECT_THAT(ended->err, HasSubstr("--link-key-file"));
}

TEST(TokenCommand, NamesAKeyThatIsNone) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "key").string();
    std::ofstream{path} << "nothing";
    std::filesystem::permissions(path, std::filesystem::perms::owner_read);
    const auto bad = runVolcast({"token", "--key-file", path});
    ASSERT_TRUE(bad.has_value());
    EXPECT_EQ(bad->exitCode, 1);
    EXPECT_THAT(bad->err, HasSubstr(path));
    for (const auto& wrong : {std::vector<std::string>{"token"},
                              {"token", "--key-file", path, "--role", "owner"},
                              {"token", "--key-file", path, "--hours", "0"}}) {
        const auto usage = runVolcast(wrong);
        ASSERT_TRUE(usage.has_value());
        EXPECT_EQ(usage->exitCode, 2);
    }
}

}  // namespace
}  // namespace volcast::test
