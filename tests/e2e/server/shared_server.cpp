#include "tests/e2e/server/shared_server.h"

#include <boost/json.hpp>

namespace volcast::test {

std::unique_ptr<TemporaryFolder> SharedServer::folder;
std::unique_ptr<ServerProcess> SharedServer::process;

void SharedServer::SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    writeTetgenCube(folder->path() / "again");
    writeTetgenCube(folder->path() / "good");
    writeFile(folder->path() / "broken.vtu", "<VTKFile type=\"Unstructured");
    process = std::make_unique<ServerProcess>(
        std::vector<std::string>{folder->path().string(), "--log-level", "debug"});
}

void SharedServer::TearDownTestSuite() {
    process.reset();
    folder.reset();
}

ServerProcess& SharedServer::server() {
    return *process;
}
const std::filesystem::path& SharedServer::data() {
    return folder->path();
}

boost::json::value SharedServer::readiness() {
    boost::system::error_code error;
    return boost::json::parse(http(port(), "/readyz").body, error);
}

std::unique_ptr<TestClient> SharedServer::clientWithView(TestClient::Form form) {
    auto client = std::make_unique<TestClient>(port(), form);
    if (!client->ok()) return nullptr;
    client->openView(1, "good.node");
    if (!client->waitForFrame(1, 1)) return nullptr;
    return client;
}

}  // namespace volcast::test
