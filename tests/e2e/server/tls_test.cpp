// HTTPS and wss with a certificate that the test makes; clients are OpenSSL's own and ours.
#include <boost/json.hpp>
#include <gmock/gmock.h>

#include "tests/e2e/server/raw_socket.h"
#include "tests/e2e/server/shared_server.h"
#include "tests/e2e/server/shell.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

class Tls : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        makeCertificate(folder->path());
        process = std::make_unique<ServerProcess>(std::vector<std::string>{
            "--tls-cert", file("cert.pem"), "--tls-key", file("key.pem"), "--log-level", "debug"});
    }
    static void TearDownTestSuite() {
        process.reset();
        folder.reset();
    }
    void SetUp() override { ASSERT_TRUE(process->ready()) << process->log(); }

    static std::string file(const std::string& name) { return folder->path() / name; }
    static std::string address() { return "127.0.0.1:" + std::to_string(process->port()); }
    /// A GET through Python's TLS, with one version alone offered.
    static std::pair<std::string, int> get(const std::string& path, const std::string& version) {
        return outputOf(
            "/usr/bin/python3 -c '"
            "import ssl, urllib.request as r\n"
            "c = ssl.create_default_context(cafile=\"" +
            file("cert.pem") +
            "\")\n"
            "c.set_ciphers(\"ALL:@SECLEVEL=0\")\n"
            "c.minimum_version = c.maximum_version = ssl.TLSVersion." +
            version + "\nprint(r.urlopen(\"https://" + address() + path +
            "\", context=c, timeout=20).read().decode())'");
    }

    static std::unique_ptr<TemporaryFolder> folder;
    static std::unique_ptr<ServerProcess> process;
};
std::unique_ptr<TemporaryFolder> Tls::folder;
std::unique_ptr<ServerProcess> Tls::process;

TEST_F(Tls, ClientsSeeFramesOverWss) {
    const auto ran = runVolcast({"load", "https://" + address(), "--trust", file("cert.pem"),
                                 "--clients", "orbit=2,shaped", "--duration", "1", "--width", "64",
                                 "--height", "48", "--max-errors", "0", "--json"});
    ASSERT_TRUE(ran.has_value());
    ASSERT_EQ(ran->exitCode, 0) << ran->err;
    const auto report = boost::json::parse(ran->out);
    for (const char* kind : {"orbit", "shaped"}) {
        EXPECT_GT(report.at("kinds").at(kind).at("frames").to_number<int>(), 0) << kind;
    }
}

TEST_F(Tls, AClientThatDoesNotTrustTheCertificateSaysSo) {
    const auto ran = runVolcast({"load", "wss://" + address(), "--duration", "1"});
    ASSERT_TRUE(ran.has_value());
    EXPECT_EQ(ran->exitCode, 1);
    EXPECT_THAT(ran->err, HasSubstr("certificate verify failed"));
}

TEST_F(Tls, HttpIsServedByVersions12And13Only) {
    for (const char* version : {"TLSv1_2", "TLSv1_3"}) {
        const auto [text, status] = get("/healthz", version);
        EXPECT_EQ(status, 0) << text;
        EXPECT_THAT(text, HasSubstr("ok")) << version;
    }
    for (const char* version : {"TLSv1", "TLSv1_1"}) {
        const auto [text, status] = get("/healthz", version);
        EXPECT_NE(status, 0) << text;
        EXPECT_THAT(text, HasSubstr("ALERT_PROTOCOL_VERSION")) << version;
    }
}

TEST_F(Tls, PlainHttpAndHandshakesThatNeverEndCostNothing) {
    RawSocket plain{process->port()};
    ASSERT_TRUE(plain.send("GET / HTTP/1.1\r\nHost: x\r\n\r\n"));
    EXPECT_TRUE(plain.readToEnd());
    RawSocket half{process->port()};
    ASSERT_TRUE(half.send(std::string{"\x16\x03\x01\x02\x00\x01", 6}));
    EXPECT_TRUE(half.readToEnd());
    EXPECT_EQ(get("/healthz", "TLSv1_3").second, 0);
}

TEST_F(Tls, FilesThatAreWrongAreNamed) {
    const TemporaryFolder other;
    makeCertificate(other.path());
    const std::string otherKey = other.path() / "key.pem";
    writeFile(other.path() / "empty.pem", "");
    writeFile(other.path() / "text.pem", "no PEM at all\n");
    const std::string locked = other.path() / "locked.pem";
    ASSERT_EQ(
        outputOf("openssl ec -aes128 -passout pass:secret -in " + otherKey + " -out " + locked)
            .second,
        0);
    const std::string cert = file("cert.pem"), key = file("key.pem");
    const std::vector<std::pair<std::vector<std::string>, std::string>> rows{
        {{"--tls-cert", cert}, "belong together"},
        {{"--tls-key", key}, "belong together"},
        {{"--tls-cert", "/nonexistent.pem", "--tls-key", key}, "/nonexistent.pem: No such file"},
        {{"--tls-cert", cert, "--tls-key", "/nonexistent.pem"}, "/nonexistent.pem: No such file"},
        {{"--tls-cert", cert, "--tls-key", other.path() / "empty.pem"}, "empty.pem: is empty"},
        {{"--tls-cert", other.path() / "text.pem", "--tls-key", key}, "text.pem: not a PEM file"},
        {{"--tls-cert", cert, "--tls-key", other.path() / "text.pem"}, "text.pem: not a PEM file"},
        {{"--tls-cert", cert, "--tls-key", otherKey}, "is not the key of the certificate"},
        {{"--tls-cert", cert, "--tls-key", locked}, "private key without password"},
    };
    for (const auto& [options, named] : rows) {
        std::vector<std::string> arguments{"serve", "--port", "0"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto ran = runVolcast(arguments);
        ASSERT_TRUE(ran.has_value());
        EXPECT_EQ(ran->exitCode, 1) << named;
        EXPECT_EQ(ran->out, "");
        EXPECT_THAT(ran->err, HasSubstr(named));
    }
}

}  // namespace
}  // namespace volcast::test
