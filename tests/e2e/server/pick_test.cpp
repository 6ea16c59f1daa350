// What single pixels of a live view show, over a real socket from a real worker.
#include <algorithm>
#include <cmath>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class Picking : public SharedServer {
protected:
    static v1::ClientMessage pick(std::uint32_t view, std::uint64_t inputSeq, std::uint32_t x,
                                  std::uint32_t y) {
        v1::ClientMessage message;
        message.mutable_pick()->set_view(view);
        message.mutable_pick()->set_input_seq(inputSeq);
        message.mutable_pick()->set_x(x);
        message.mutable_pick()->set_y(y);
        return message;
    }

    static std::optional<v1::Picked> waitForPicked(TestClient& client) {
        const auto found = client.waitFor([](const auto& one) { return one.has_picked(); });
        if (!found) return std::nullopt;
        return found->picked();
    }
};

TEST_F(Picking, APixelOfTheDataHasAPlaceAndAValue) {
    for (const auto form : {TestClient::Form::kBinary, TestClient::Form::kJson}) {
        TestClient client{port(), form};
        ASSERT_TRUE(client.ok());
        const auto list = client.waitFor([](const auto& one) { return one.has_dataset_list(); });
        ASSERT_TRUE(list.has_value());
        client.openView(3, "good.node", 64, 48, 9);
        ASSERT_TRUE(client.waitForFrame(3, 9).has_value());
        client.send(pick(3, 9, 32, 24));
        const auto picked = waitForPicked(client);
        ASSERT_TRUE(picked.has_value());
        EXPECT_EQ(picked->view(), 3U);
        EXPECT_EQ(picked->input_seq(), 9U);
        EXPECT_EQ(picked->x(), 32U);
        EXPECT_EQ(picked->y(), 24U);
        EXPECT_FALSE(picked->layer().empty());
        ASSERT_EQ(picked->values_size(), 1);
        EXPECT_FALSE(picked->values(0).field().empty());
        EXPECT_TRUE(std::isfinite(picked->values(0).value()));
        EXPECT_TRUE(picked->has_cell());
        EXPECT_GT(picked->distance(), 0.0);
    }
}

TEST_F(Picking, APixelBesideTheDataIsEmpty) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->send(pick(1, 0, 0, 0));
    const auto picked = waitForPicked(*client);
    ASSERT_TRUE(picked.has_value());
    EXPECT_GT(picked->input_seq(), 0U) << "of the newest picture, which it names";
    EXPECT_TRUE(picked->layer().empty());
    EXPECT_EQ(picked->values_size(), 0);
}

TEST_F(Picking, TheFrameThatTheClientNamesIsMeantAndNotTheNewest) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.0);
    ASSERT_TRUE(client->waitForFrame(1, 2).has_value());
    client->look(1, 3, 1.0);
    ASSERT_TRUE(client->waitForFrame(1, 3).has_value());
    const auto positionIn = [&](std::uint64_t inputSeq) {
        client->send(pick(1, inputSeq, 32, 24));
        const auto picked = waitForPicked(*client);
        return picked ? picked->position() : v1::Vec3{};
    };
    const v1::Vec3 before = positionIn(2), now = positionIn(3), newest = positionIn(0);
    EXPECT_GT(std::hypot(before.x() - now.x(), before.y() - now.y(), before.z() - now.z()), 1e-3);
    EXPECT_EQ(now.x(), newest.x());
    EXPECT_EQ(now.z(), newest.z());
}

TEST_F(Picking, WhatCannotBePickedIsRefusedAndTheViewGoesOn) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    struct Case {
        v1::ClientMessage message;
        v1::ErrorCode code;
        const char* field;
    };
    for (const Case& one :
         {Case{pick(9, 1, 0, 0), v1::ERROR_CODE_NOT_FOUND, "view"},
          Case{pick(1, 77, 0, 0), v1::ERROR_CODE_NOT_FOUND, "input_seq"},
          Case{pick(1, 0, 100000, 0), v1::ERROR_CODE_INVALID_ARGUMENT, "x"},
          Case{pick(1, 0, 0, 4000000000U), v1::ERROR_CODE_INVALID_ARGUMENT, "y"}}) {
        client->send(one.message);
        const auto error = client->waitForError();
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->code(), one.code) << error->message();
        EXPECT_EQ(error->field(), one.field) << error->message();
    }
    client->look(1, 5, 0.3);
    EXPECT_TRUE(client->waitForFrame(1, 5).has_value());
}

}  // namespace
}  // namespace volcast::test
