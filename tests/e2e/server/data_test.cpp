// The catalogue as clients see it: imports, broken files, changed files, vanished files.
#include <filesystem>

#include <gmock/gmock.h>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

class Data : public SharedServer {
protected:
    static void openDataset(TestClient& client, const std::string& id) {
        v1::ClientMessage message;
        message.mutable_open_dataset()->set_dataset(id);
        client.send(message);
    }
};

TEST_F(Data, ADatasetIsImportedOnDemandAndEverybodyHearsOfIt) {
    writeTetgenCube(data() / "demand");
    TestClient asks{port()}, listens{port()};
    ASSERT_TRUE(asks.ok() && listens.ok());
    ASSERT_TRUE(listens.waitFor([](const auto& one) { return one.has_dataset_list(); }));
    openDataset(asks, "demand.node");
    for (TestClient* client : {&asks, &listens}) {
        const auto info = client->waitForDataset("demand.node", v1::DATASET_STATE_READY);
        ASSERT_TRUE(info.has_value()) << server().log();
        EXPECT_EQ(info->kind(), v1::DATASET_KIND_MESH);
        EXPECT_EQ(info->cells(), 6000U);
        EXPECT_EQ(info->vertices(), 1331U);
        ASSERT_EQ(info->fields_size(), 1);
        EXPECT_NEAR(info->fields(0).min(), 0.0, 1e-6);
        EXPECT_NEAR(info->fields(0).max(), 6.0, 1e-5);
        EXPECT_EQ(info->version(), 1U);
    }
}

TEST_F(Data, AViewWaitsForItsDataAndThenDraws) {
    writeTetgenCube(data() / "waits");
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "waits.node");
    EXPECT_TRUE(client.waitForState(1, v1::VIEW_STATE_WAITING).has_value());
    EXPECT_TRUE(client.waitForState(1, v1::VIEW_STATE_ACTIVE).has_value());
    EXPECT_TRUE(client.waitForFrame(1, 1).has_value());
}

TEST_F(Data, ABrokenFileFailsWithAReasonWhileOthersAreServed) {
    const auto other = clientWithView();
    TestClient client{port()};
    ASSERT_TRUE(other && client.ok());
    client.openView(1, "broken.vtu");
    const auto info = client.waitForDataset("broken.vtu", v1::DATASET_STATE_FAILED);
    ASSERT_TRUE(info.has_value());
    EXPECT_THAT(info->error(), HasSubstr("broken.vtu"));
    const auto error = client.waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_IMPORT_FAILED);
    EXPECT_EQ(error->view(), 1U);
    EXPECT_TRUE(client.waitForState(1, v1::VIEW_STATE_FAILED).has_value());
    other->look(1, 2, 1.1);
    EXPECT_TRUE(other->waitForFrame(1, 2).has_value());
    // The view lives: good data can be shown in it.
    v1::ClientMessage message;
    message.mutable_update()->set_view(1);
    message.mutable_update()->set_input_seq(2);
    v1::Scene& scene = *message.mutable_update()->mutable_scene();
    scene.mutable_camera()->mutable_eye()->set_z(4);
    scene.mutable_camera()->mutable_center();
    scene.mutable_camera()->mutable_up()->set_y(1);
    scene.mutable_camera()->set_fovy_degrees(40);
    scene.add_layers()->set_id("a");
    scene.mutable_layers(0)->set_dataset("good.node");
    scene.mutable_layers(0)->set_model(v1::RAY_MODEL_SURFACE);
    scene.mutable_layers(0)->mutable_transfer_function()->add_points();
    client.send(message);
    EXPECT_TRUE(client.waitForFrame(1, 2).has_value()) << server().log();
}

TEST_F(Data, AFailedImportIsTriedAgainOnceTheFileIsMended) {
    writeFile(data() / "mended.node", "3 3 0 0\n0 0 0\n");
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    openDataset(client, "mended.node");
    ASSERT_TRUE(client.waitForDataset("mended.node", v1::DATASET_STATE_FAILED).has_value());
    writeTetgenCube(data() / "mended");
    openDataset(client, "mended.node");
    EXPECT_TRUE(client.waitForDataset("mended.node", v1::DATASET_STATE_READY).has_value());
}

TEST_F(Data, AChangedFileIsReadAgainAndItsViewsAreDrawnAnew) {
    writeTetgenCube(data() / "changes");
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "changes.node");
    const auto before = client.waitForLossless(1, 1);
    ASSERT_TRUE(before.has_value());
    EXPECT_EQ(before->header.data_version(), 1U);
    std::filesystem::last_write_time(
        data() / "changes.ele",
        std::filesystem::last_write_time(data() / "changes.ele") + std::chrono::seconds{7});
    openDataset(client, "changes.node");
    const auto info = client.waitFor([](const auto& one) {
        return one.has_dataset_info() && one.dataset_info().version() == 2;
    });
    ASSERT_TRUE(info.has_value());
    const auto after = client.waitForFrame(
        [](const TestFrame& frame) { return frame.header.data_version() == 2; });
    ASSERT_TRUE(after.has_value());
}

TEST_F(Data, DataThatVanishedIsNamedAndWhatIsLoadedStaysUsable) {
    writeTetgenCube(data() / "vanishes");
    writeTetgenCube(data() / "unread");
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "vanishes.node");
    ASSERT_TRUE(client.waitForFrame(1, 1).has_value());
    for (const char* name : {"vanishes.node", "vanishes.ele", "unread.node", "unread.ele"}) {
        std::filesystem::remove(data() / name);
    }
    for (const char* id : {"vanishes.node", "unread.node"}) {
        openDataset(client, id);
        const auto error = client.waitForError();
        ASSERT_TRUE(error.has_value()) << id;
        EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_FOUND);
        EXPECT_EQ(error->dataset(), id);
        EXPECT_THAT(error->message(), HasSubstr(id));
    }
    client.look(1, 2, 0.9);
    EXPECT_TRUE(client.waitForFrame(1, 2).has_value());
    client.openView(2, "vanishes.node");
    EXPECT_TRUE(client.waitForFrame(2, 1).has_value());
}

}  // namespace
}  // namespace volcast::test
