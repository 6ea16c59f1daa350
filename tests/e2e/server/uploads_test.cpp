// Uploads over HTTP as scripts and hostile clients send them.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/e2e/server/raw_socket.h"
#include "tests/e2e/server/shared_server.h"
#include "tests/e2e/server/shell.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

class Uploads : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        writeTetgenCube(folder->path() / "own");
        process = std::make_unique<ServerProcess>(
            std::vector<std::string>{folder->path().string(), "--allow-uploads", "--max-upload-mb",
                                     "1", "--upload-keep-free-mb", "1", "--max-uploads-at-once",
                                     "2", "--upload-patience-s", "5", "--import-memory-mb", "256"});
    }
    static void TearDownTestSuite() {
        process.reset();
        folder.reset();
    }
    void SetUp() override {
        ASSERT_TRUE(process->ready()) << process->log();
        token = "token" + std::to_string(1'000'000'000'000 + ++last);
    }
    static std::uint16_t port() { return process->port(); }
    [[nodiscard]] std::string path(const std::string& more = {}) const {
        return "/v1/uploads/" + token + more;
    }
    [[nodiscard]] HttpReply put(const std::string& name, const std::string& body,
                                const std::string& headers = {}) const {
        return http(port(), path("/" + name), "PUT",
                    headers + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }
    [[nodiscard]] HttpReply finish(const std::string& name) const {
        return http(port(), path("?name=" + name), "POST");
    }
    static bool unfinishedIsGone(const std::string& token) {
        return eventually(
            [&] { return !std::filesystem::exists(folder->path() / "uploads" / ("." + token)); });
    }
    static std::string textOf(const std::filesystem::path& path) {
        std::stringstream text;
        text << std::ifstream{path}.rdbuf();
        return text.str();
    }
    static std::unique_ptr<TemporaryFolder> folder;
    static std::unique_ptr<ServerProcess> process;
    static std::uint64_t last;
    std::string token;
};
std::unique_ptr<TemporaryFolder> Uploads::folder;
std::unique_ptr<ServerProcess> Uploads::process;
std::uint64_t Uploads::last = 0;

TEST_F(Uploads, FilesOfOneDatasetAppearInEveryClientsListAndAreDrawn) {
    TestClient one{port()}, two{port()};
    ASSERT_TRUE(one.ok() && two.ok());
    for (TestClient* client : {&one, &two}) {
        const auto welcome = client->waitForWelcome();
        ASSERT_TRUE(welcome.has_value());
        EXPECT_EQ(welcome->uploads().max_bytes(), 1U << 20U);
    }
    for (const char* end : {".node", ".ele"}) {
        const HttpReply reply =
            put(std::string{"cube"} + end, textOf(folder->path() / (std::string{"own"} + end)));
        EXPECT_EQ(reply.status, 201U) << reply.body;
    }
    const HttpReply done = finish("my%20cube");
    EXPECT_EQ(done.status, 201U) << done.body;
    EXPECT_EQ(done.headers.at("content-type"), "application/json");
    EXPECT_THAT(done.body, HasSubstr(R"({"datasets":["uploads/my cube/cube.node"]})"));
    for (TestClient* client : {&one, &two}) {
        EXPECT_TRUE(client->waitForDataset("uploads/my cube/cube.node", v1::DATASET_STATE_LISTED));
    }
    one.openView(1, "uploads/my cube/cube.node");
    EXPECT_TRUE(one.waitForFrame(1, 1).has_value()) << process->log();
    const auto info = two.waitForDataset("uploads/my cube/cube.node", v1::DATASET_STATE_READY);
    ASSERT_TRUE(info.has_value());
    EXPECT_EQ(info->log().format(), "TetGen");
    EXPECT_GT(info->log().ms(), 0.0);
    EXPECT_NEAR(info->fields(0).mean(), 3.0, 0.1);  // f = x + 2 y + 3 z over the unit cube.
    // A picture for the list is drawn for whoever asks, and everybody gets it.
    v1::ClientMessage message;
    message.mutable_draw_dataset_thumbnail()->set_dataset("uploads/my cube/cube.node");
    two.send(message);
    const auto drawn = one.waitFor([](const v1::ServerMessage& news) {
        return news.has_dataset_info() && !news.dataset_info().thumbnail().empty();
    });
    ASSERT_TRUE(drawn.has_value()) << process->log();
    EXPECT_EQ(drawn->dataset_info().thumbnail().substr(0, 3), "\xff\xd8\xff");
    message.mutable_draw_dataset_thumbnail()->set_dataset("nothing");
    two.send(message);
    const auto error = two.waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_FOUND);
}

TEST_F(Uploads, NamesThatLeadOutAndOtherMethodsAreRefused) {
    for (const char* name : {"..%2f..%2fout.vtu", "%2e%2e", ".hidden.vtu", "a%2fb.vtu",
                             "../out.vtu", "d/e.vtu", "%ff.vtu", "a%0ab"}) {
        EXPECT_EQ(put(name, "x").status, 400U) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(folder->path() / "out.vtu"));
    EXPECT_FALSE(std::filesystem::exists(folder->path() / "uploads/out.vtu"));
    const HttpReply posted = http(port(), path("/a.vtu"), "POST");
    EXPECT_EQ(posted.status, 405U);
    EXPECT_EQ(posted.headers.at("allow"), "PUT");
    EXPECT_EQ(http(port(), path("/a.vtu")).status, 405U);
    EXPECT_EQ(http(port(), path()).headers.at("allow"), "POST, DELETE");
    EXPECT_EQ(http(port(), "/v1/uploads/short/a.vtu", "PUT").status, 400U);
    EXPECT_EQ(finish("x").status, 404U);
    EXPECT_EQ(http(port(), path(), "DELETE").status, 404U);
}

TEST_F(Uploads, PagesOfOtherOriginsMayNot) {
    EXPECT_EQ(put("a.vtu", "x", "Origin: http://evil.example\r\n").status, 403U);
    EXPECT_EQ(put("a.vtu", "x", "Origin: null\r\n").status, 403U);
    EXPECT_EQ(http(port(), path("?name=x"), "POST", "Origin: http://evil.example\r\n").status,
              403U);
    const std::string own = "Origin: http://127.0.0.1:" + std::to_string(port()) + "\r\n";
    EXPECT_EQ(put("a.vtu", "x", own).status, 201U);
    EXPECT_EQ(http(port(), path(), "DELETE", own).status, 200U);
    EXPECT_TRUE(unfinishedIsGone(token));
}

TEST_F(Uploads, WhatIsTooLargeIsRefusedBeforeItIsSentAndWhileItIs) {
    const std::string mib(std::size_t{1} << 20U, 'x');
    const HttpReply announced = put("a.vtu", mib + "x");
    EXPECT_EQ(announced.status, 413U);
    EXPECT_THAT(announced.body, HasSubstr("1.0 MiB"));
    // Chunked: nobody knows the size before it is there.
    std::ostringstream body;
    body << std::hex << mib.size() << "\r\n" << mib << "\r\n1\r\nx\r\n0\r\n\r\n";
    const HttpReply chunked =
        http(port(), path("/a.vtu"), "PUT", "Transfer-Encoding: chunked\r\n\r\n" + body.str());
    EXPECT_EQ(chunked.status, 413U);
    EXPECT_EQ(put("b.vtu", mib).status, 201U);
    EXPECT_EQ(put("b.vtu", "").status, 409U) << "a name is given once";
    EXPECT_EQ(put("c.vtu", "x").status, 413U) << "all files of an upload count";
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, AChunkedFileIsTakenAsItCame) {
    const HttpReply sent = http(port(), path("/a.node"), "PUT",
                                "Transfer-Encoding: chunked\r\n\r\n4\r\n1 3 \r\n5\r\n0 0\n1"
                                "\r\n0\r\n\r\n");
    EXPECT_EQ(sent.status, 201U);
    EXPECT_THAT(sent.body, HasSubstr(R"("bytes":9)"));
    EXPECT_EQ(textOf(folder->path() / "uploads" / ("." + token) / "a.node"), "1 3 0 0\n1");
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, AClientThatGoesAwayLeavesNothingBehind) {
    {
        const RawSocket socket{port()};
        ASSERT_TRUE(socket.send("PUT " + path("/a.vtu") +
                                " HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\nhalf"));
        ASSERT_TRUE(eventually([&] {
            return std::filesystem::exists(folder->path() / "uploads" / ("." + token) /
                                           ".part.a.vtu");
        }));
    }
    EXPECT_TRUE(eventually([&] {
        return !std::filesystem::exists(folder->path() / "uploads" / ("." + token) / ".part.a.vtu");
    }));
    EXPECT_EQ(finish("x").status, 422U);
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, WhoSendsTooSlowlyIsToldSoAndMakesRoom) {
    const HttpReply slow = rawHttp(port(), "PUT " + path("/a.vtu") +
                                               " HTTP/1.1\r\nHost: x\r\nContent-Length: 1000"
                                               "\r\n\r\nhalf");
    EXPECT_EQ(slow.status, 408U);
    EXPECT_THAT(slow.body, HasSubstr("--upload-patience-s"));
    EXPECT_EQ(put("a.vtu", "x").status, 201U);
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, MoreFilesAtOnceThanAllowedWait) {
    const std::string head = " HTTP/1.1\r\nHost: x\r\nContent-Length: 900000\r\n\r\n";
    const RawSocket one{port()}, two{port()};
    ASSERT_TRUE(one.send("PUT " + path("/a.vtu") + head));
    ASSERT_TRUE(two.send("PUT " + path("/b.vtu") + head));
    const auto there = [&](const char* name) {
        return std::filesystem::exists(folder->path() / "uploads" / ("." + token) / name);
    };
    // Patience is short here: whoever is too late to see both finds them over, and is let in.
    if (!eventually([&] { return there(".part.a.vtu") && there(".part.b.vtu"); })) {
        FAIL() << process->log();
    }
    const HttpReply third = put("c.vtu", "x");
    EXPECT_EQ(third.status, 503U) << third.body;
    EXPECT_THAT(third.body, HasSubstr("later"));
    EXPECT_TRUE(eventually([&] { return put("c.vtu", "x").status == 201U; }));
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, AConnectionThatExpectsToBeToldIsTold) {
    RawSocket socket{port()};
    ASSERT_TRUE(socket.send("PUT " + path("/a.vtu") +
                            " HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\n"
                            "Content-Length: 4\r\n\r\n"));
    EXPECT_THAT(socket.readHead(), HasSubstr("100 Continue"));
    ASSERT_TRUE(socket.send("data"));
    EXPECT_THAT(socket.readHead(), HasSubstr("201 Created"));
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
}

TEST_F(Uploads, FilesThatNoLoaderTakesAreNamed) {
    EXPECT_EQ(put("letter.doc", "Dear").status, 201U);
    const HttpReply reply = finish("letter");
    EXPECT_EQ(reply.status, 422U);
    EXPECT_THAT(reply.body, HasSubstr("letter"));
    EXPECT_EQ(http(port(), path(), "DELETE").status, 200U);
    EXPECT_TRUE(unfinishedIsGone(token));
}

v1::DatasetInfo failedImport(std::uint16_t port, const std::string& id) {
    TestClient client{port};
    v1::ClientMessage message;
    message.mutable_open_dataset()->set_dataset(id);
    client.send(message);
    const auto info = client.waitFor([&](const v1::ServerMessage& news) {
        const auto state = news.dataset_info().state();
        return news.has_dataset_info() && news.dataset_info().id() == id &&
               (state == v1::DATASET_STATE_FAILED || state == v1::DATASET_STATE_READY);
    });
    return info ? info->dataset_info() : v1::DatasetInfo{};
}

// A header may name any file; the importer sees none but those of its own upload.
TEST_F(Uploads, AFileThatPointsAtOthersReadsNone) {
    const std::string target = (folder->path() / "own.ele").string();
    for (const std::string& named : {std::string{"../../own.ele"}, target}) {
        token += "x";
        EXPECT_EQ(put("a.mhd",
                      "ObjectType = Image\nNDims = 3\nDimSize = 8 8 8\n"
                      "ElementType = MET_UCHAR\nElementDataFile = " +
                          named + "\n")
                      .status,
                  201U);
        const std::string name = "points" + std::to_string(named.size());
        EXPECT_EQ(finish(name).status, 201U);
        const auto info = failedImport(port(), "uploads/" + name + "/a.mhd");
        EXPECT_EQ(info.state(), v1::DATASET_STATE_FAILED) << named;
        EXPECT_THAT(info.error(), HasSubstr("a.mhd"));
    }
}

// 1 GiB of zeros that less than 1 MiB unpacks to, whether the header says so or not: the import's
// memory is limited, the server's untouched.
TEST_F(Uploads, ABombIsDefusedByTheImport) {
    const TemporaryFolder made;
    const auto [said, status] = outputOf("cd '" + made.path().string() +
                                         "' && /usr/bin/python3 -I " VOLCAST_SOURCE_DIR
                                         "/tests/support/bombs.py honest.nrrd small.nii.gz");
    ASSERT_EQ(status, 0) << said;
    const std::vector<std::pair<std::string, std::string>> bombs{
        {"honest.nrrd", "unpacks to 1073741824 bytes, this import may use 268435456"},
        {"small.nii.gz", "holds more than the 416 bytes that its header says"}};
    for (const auto& [name, reason] : bombs) {
        token += "x";
        const std::string bomb = textOf(made.path() / name);
        EXPECT_GT(bomb.size(), 900'000U);
        EXPECT_EQ(put(name, bomb).status, 201U);
        EXPECT_EQ(finish("bomb%20" + name.substr(0, 1)).status, 201U);
        const auto info = failedImport(port(), "uploads/bomb " + name.substr(0, 1) + "/" + name);
        EXPECT_EQ(info.state(), v1::DATASET_STATE_FAILED) << name;
        EXPECT_THAT(info.error(), AllOf(HasSubstr(name), HasSubstr(reason)));
    }
    EXPECT_EQ(http(port(), "/healthz").status, 200U);
}

TEST(UploadsOff, AreRefusedAndNotOffered) {
    const TemporaryFolder folder;
    writeTetgenCube(folder.path() / "own");
    const ServerProcess server{{folder.path().string()}};
    ASSERT_TRUE(server.ready()) << server.log();
    const HttpReply reply = http(server.port(), "/v1/uploads/0123456789abcdef/a.vtu", "PUT",
                                 "Content-Length: 1\r\n\r\nx");
    EXPECT_EQ(reply.status, 403U);
    EXPECT_THAT(reply.body, HasSubstr("--allow-uploads"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "uploads"));
    TestClient client{server.port()};
    const auto welcome = client.waitForWelcome();
    ASSERT_TRUE(welcome.has_value());
    EXPECT_FALSE(welcome->has_uploads());
}

TEST(UploadsOff, WithoutAFolderTheyCannotBeOn) {
    const auto ended = runVolcast({"serve", "--port", "0", "--allow-uploads"});
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 1);
    EXPECT_THAT(ended->err, HasSubstr("DATA_DIR"));
}

TEST(UploadsFull, ADiskThatIsNearlyFullIsKeptSo) {
    const TemporaryFolder folder;
    const ServerProcess server{
        {folder.path().string(), "--allow-uploads", "--upload-keep-free-mb", "1000000000"}};
    ASSERT_TRUE(server.ready()) << server.log();
    const HttpReply reply = http(server.port(), "/v1/uploads/0123456789abcdef/a.vtu", "PUT",
                                 "Content-Length: 1\r\n\r\nx");
    EXPECT_EQ(reply.status, 507U);
    EXPECT_THAT(reply.body, HasSubstr("stay free"));
}

}  // namespace
}  // namespace volcast::test
