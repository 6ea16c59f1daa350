// Small pictures of other scenes, over a real socket from a real worker.
#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class Thumbnails : public SharedServer {
protected:
    static v1::ClientMessage draw(const v1::Scene& scene, std::uint32_t request,
                                  std::uint32_t width = 96, std::uint32_t height = 72) {
        v1::ClientMessage message;
        v1::DrawThumbnail& thumbnail = *message.mutable_draw_thumbnail();
        thumbnail.set_view(1);
        thumbnail.set_request(request);
        *thumbnail.mutable_scene() = scene;
        thumbnail.set_width(width);
        thumbnail.set_height(height);
        return message;
    }

    static std::optional<v1::Thumbnail> waitForThumbnail(TestClient& client) {
        const auto found = client.waitFor([](const auto& one) { return one.has_thumbnail(); });
        if (!found) return std::nullopt;
        return found->thumbnail();
    }

    static Decoded pictureOf(const v1::Thumbnail& thumbnail) {
        TestFrame frame;
        frame.header.set_codec(thumbnail.codec());
        const auto bytes = std::as_bytes(std::span{thumbnail.picture()});
        frame.payload.assign(bytes.begin(), bytes.end());
        return decode(frame);
    }

    /// A client with view 1 of the cube open, and its scene.
    static std::unique_ptr<TestClient> open(v1::Scene& scene, const v1::Hello& hello = {},
                                            std::optional<TestFrame>* first = nullptr) {
        auto client =
            std::make_unique<TestClient>(port(), TestClient::Form::kBinary, WsOptions{}, hello);
        if (!client->ok()) return nullptr;
        client->openView(1, "good.node");
        const auto opened = client->waitForOpened();
        if (!opened) return nullptr;
        auto frame = client->waitForFrame(1, 1);
        if (!frame) return nullptr;
        if (first != nullptr) *first = std::move(frame);
        scene = opened->scene();
        return client;
    }
};

TEST_F(Thumbnails, ShowTheSceneThatIsAskedFor) {
    v1::Scene scene;
    const auto client = open(scene);
    ASSERT_TRUE(client);
    std::vector<Decoded> pictures;
    for (const auto model : {v1::RAY_MODEL_VOLUME, v1::RAY_MODEL_SURFACE, v1::RAY_MODEL_MIP}) {
        scene.mutable_layers(0)->set_model(model);
        client->send(draw(scene, static_cast<std::uint32_t>(model)));
        const auto thumbnail = waitForThumbnail(*client);
        ASSERT_TRUE(thumbnail.has_value());
        EXPECT_EQ(thumbnail->view(), 1U);
        EXPECT_EQ(thumbnail->request(), static_cast<std::uint32_t>(model));
        EXPECT_EQ(thumbnail->refusal(), "");
        EXPECT_EQ(thumbnail->codec(), v1::CODEC_JPEG);
        EXPECT_LT(thumbnail->picture().size(), 8192U);
        const Decoded picture = pictureOf(*thumbnail);
        EXPECT_EQ(picture.width, 96);
        EXPECT_EQ(picture.height, 72);
        for (const Decoded& other : pictures) EXPECT_GT(meanDifference(other, picture), 0.5);
        pictures.push_back(picture);
    }
    // The view goes on as it was.
    client->look(1, 2, 0.3);
    EXPECT_TRUE(client->waitForLossless(1, 2).has_value());
}

TEST_F(Thumbnails, AreThePictureOfAViewOfThatScene) {
    v1::Hello hello;
    hello.add_codecs(v1::CODEC_PNG);
    v1::Scene scene;
    std::optional<TestFrame> frame;  // Lossless: nothing else is shown to this client.
    const auto client = open(scene, hello, &frame);
    ASSERT_TRUE(client && frame.has_value());
    client->send(draw(scene, 5, 64, 48));
    const auto thumbnail = waitForThumbnail(*client);
    ASSERT_TRUE(thumbnail.has_value());
    EXPECT_EQ(thumbnail->codec(), v1::CODEC_PNG);
    EXPECT_EQ(pictureOf(*thumbnail).pixels, decode(*frame).pixels);
}

TEST_F(Thumbnails, OfBadScenesAreRefusedWithTheField) {
    v1::Scene scene;
    const auto client = open(scene);
    ASSERT_TRUE(client);
    v1::Scene unknown = scene;
    unknown.mutable_layers(0)->set_dataset("nowhere.vtu");
    v1::Scene unloaded = scene;
    unloaded.mutable_layers(0)->set_dataset("broken.vtu");
    v1::Scene code = scene;
    code.mutable_layers(0)->mutable_shader()->set_code("void main() { emitRGB(vec3(1.0)); }");
    v1::Scene levels = scene;
    levels.mutable_layers(0)->set_model(v1::RAY_MODEL_ISOSURFACE);
    levels.mutable_layers(0)->clear_levels();
    struct Row {
        v1::ClientMessage message;
        v1::ErrorCode code;
        std::string field;
    };
    const std::vector<Row> rows{
        {draw(scene, 1, 0, 9), v1::ERROR_CODE_INVALID_ARGUMENT, "draw_thumbnail.width"},
        {draw(scene, 1, 9, 257), v1::ERROR_CODE_LIMIT_EXCEEDED, "draw_thumbnail.height"},
        {draw({}, 1), v1::ERROR_CODE_INVALID_ARGUMENT, "draw_thumbnail.scene"},
        {draw(unknown, 1), v1::ERROR_CODE_NOT_FOUND, "draw_thumbnail.scene.layers"},
        {draw(unloaded, 1), v1::ERROR_CODE_NOT_FOUND, "draw_thumbnail.scene.layers"},
        {draw(code, 1), v1::ERROR_CODE_UNSUPPORTED, "draw_thumbnail.scene.layers[0].shader"},
        {draw(levels, 1), v1::ERROR_CODE_INVALID_ARGUMENT, "draw_thumbnail.scene.layers[0].levels"},
    };
    for (const Row& row : rows) {
        client->send(row.message);
        const auto error = client->waitForError();
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->code(), row.code) << row.field << ": " << error->message();
        EXPECT_TRUE(error->field().starts_with(row.field)) << error->field();
        EXPECT_FALSE(error->message().empty());
    }
    client->send(draw(scene, 2));
    EXPECT_TRUE(waitForThumbnail(*client).has_value());
}

}  // namespace
}  // namespace volcast::test
