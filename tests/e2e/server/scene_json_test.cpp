// The scene that a client is told is a document: `volcast render --scene` draws the same pixels.
#include <fstream>

#include <boost/json.hpp>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

namespace json = boost::json;

class SceneJson : public SharedServer {
protected:
    /// The pixels of `scene`, drawn offline.
    static Decoded drawOffline(const json::value& scene) {
        const TemporaryFolder folder;
        writeFile(folder.path() / "scene.json", json::serialize(scene));
        const std::string png = (folder.path() / "a.png").string();
        const auto run = runVolcast({"render", (data() / "good.node").string(), "--scene",
                                     (folder.path() / "scene.json").string(), "--size", "64", "48",
                                     "--png", png});
        EXPECT_TRUE(run && run->exitCode == 0) << (run ? run->err : "did not run");
        TestFrame frame;
        frame.header.set_codec(v1::CODEC_PNG);
        std::ifstream file{png, std::ios::binary};
        for (char byte = 0; file.get(byte);) frame.payload.push_back(static_cast<std::byte>(byte));
        return decode(frame);
    }
    /// The next text message with `body`.
    static json::value waitForBody(WsClient& client, const std::string& body) {
        while (const auto message = client.receive(kPatience)) {
            if (!message->text) continue;
            const auto* text = reinterpret_cast<const char*>(message->bytes.data());
            const json::value all = json::parse({text, message->bytes.size()});
            if (const auto* found = all.as_object().if_contains(body)) return *found;
        }
        return nullptr;
    }
};

TEST_F(SceneJson, OfViewOpenedAndSceneChangedGivesTheSamePixelsOffline) {
    TestClient client{port(), TestClient::Form::kBinary};
    client.openView(1, "good.node");
    const auto json = WsClient::connect(port());
    json->sendText(R"({"hello": {"major": 1}})");
    json->sendText(R"({"openView": {"view": 1, "link": ")" + client.share(1, v1::ROLE_WATCH) +
                   R"(", "viewport": {"width": 64, "height": 48}}})");
    const json::value opened = waitForBody(*json, "viewOpened");
    ASSERT_TRUE(opened.is_object()) << server().log();
    const auto first = client.waitForLossless(1, 1);
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(drawOffline(opened.at("scene")).pixels, decode(*first).pixels);

    client.look(1, 2, 0.8);
    const auto looked = client.waitForLossless(1, 2);
    ASSERT_TRUE(looked.has_value());
    json::value scene = opened.at("scene");
    scene.as_object()["camera"] = waitForBody(*json, "sceneChanged").at("camera");
    const Decoded offline = drawOffline(scene);
    EXPECT_EQ(offline.pixels, decode(*looked).pixels);
    EXPECT_NE(offline.pixels, decode(*first).pixels);
}

}  // namespace
}  // namespace volcast::test
