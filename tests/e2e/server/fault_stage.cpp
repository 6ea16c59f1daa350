#include "tests/e2e/server/fault_stage.h"

#include <boost/json.hpp>

namespace volcast::test {

FaultStage::FaultStage(const std::vector<std::string>& options,
                       const ServerProcess::Environment& environment) {
    for (const char* name : {"good", "again"}) writeTetgenCube(folder.path() / name);
    std::vector<std::string> arguments{folder.path().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    server = std::make_unique<ServerProcess>(arguments, environment);
}

boost::json::value FaultStage::readiness() const {
    boost::system::error_code error;
    return boost::json::parse(http(server->port(), "/readyz").body, error);
}

int FaultStage::number(const char* key) const {
    return readiness().at(key).to_number<int>();
}

std::string FaultStage::text(const char* key) const {
    return std::string{readiness().at(key).as_string()};
}

bool FaultStage::waitForSpare() const {
    return eventually([this] { return readiness().at("spare_ready").as_bool(); });
}

void inject(TestClient& client, const std::string& fault) {
    v1::ClientMessage message;
    message.mutable_inject_fault()->set_view(1);
    message.mutable_inject_fault()->set_fault(fault);
    client.send(message);
}

Looker::Looker(std::uint16_t port, TestClient::Form form, const std::string& dataset,
               std::uint32_t width, std::uint32_t height)
    : client{std::make_unique<TestClient>(port, form)} {
    if (!client->ok()) return;
    client->openView(1, dataset, width, height);
    const auto opened =
        client->waitFor([](const auto& message) { return message.has_view_opened(); });
    if (!opened) return;
    scene = opened->view_opened().scene();
    client->look(1, 2, 0.4);
    before = client->waitForLossless(1, 2);
}

void Looker::show(const v1::Scene& shown, std::uint64_t inputSeq) const {
    v1::ClientMessage message;
    message.mutable_update()->set_view(1);
    message.mutable_update()->set_input_seq(inputSeq);
    *message.mutable_update()->mutable_scene() = shown;
    client->send(message);
}

v1::Scene Looker::otherScene() const {
    v1::Scene other = scene;
    other.mutable_layers(0)->set_dataset("again.node");
    other.mutable_layers(0)->set_model(v1::RAY_MODEL_XRAY);
    return other;
}

void Looker::expectSamePictureAgain(std::uint64_t inputSeq) const {
    show(scene, inputSeq);
    client->look(1, inputSeq + 1, 0.4);
    const auto after = client->waitForLossless(1, inputSeq + 1);
    ASSERT_TRUE(after.has_value());
    EXPECT_EQ(decode(*after).pixels, decode(*before).pixels);
    EXPECT_EQ(client->socket().closeCode(), 0);
}

}  // namespace volcast::test
