// Updates that change nothing: answered, and nothing is drawn for them.
#include "renderer/worker/scene_message.h"
#include "tests/unit/session/shared_view_fixture.h"

namespace volcast::session {
namespace {

using test::drawn;
using test::SharedViewTest;

TEST_F(SharedViewTest, AnUpdateThatChangesNothingIsAnsweredByThePictureThatIsThere) {
    const ViewerId viewer = join(), watcher = join();
    look(viewer, 2, 5.0);
    drawLast();
    std::shared_ptr<const std::vector<std::byte>> exact;
    for (const ViewerId one : {viewer, watcher}) {
        const auto jpeg = frameOf(one);
        ASSERT_TRUE(jpeg && jpeg->header.codec() == v1::CODEC_JPEG);
        ack(one, jpeg->sequence);
        const auto png = frameOf(one);
        ASSERT_TRUE(png && png->header.final());
        ack(one, png->sequence);
        exact = png->payload;
    }
    const SharedView::Counts before = view->counts();
    look(viewer, 3, 5.0);
    v1::Update whole, nothing, sameSize;
    *whole.mutable_scene() = worker::toMessage(newest().scene);
    sameSize.mutable_viewport()->set_width(8);
    sameSize.mutable_viewport()->set_height(6);
    std::uint64_t seq = 3;
    for (v1::Update* update : {static_cast<v1::Update*>(nullptr), &whole, &nothing, &sameSize}) {
        if (update != nullptr) {
            update->set_input_seq(++seq);
            ASSERT_TRUE(view->update(viewer, *update, Clock::now()).has_value());
        }
        const auto answer = frameOf(viewer);
        ASSERT_TRUE(answer.has_value()) << seq;
        EXPECT_EQ(answer->header.input_seq(), seq);
        EXPECT_TRUE(answer->header.final() && answer->header.lossless()) << seq;
        EXPECT_FALSE(answer->header.redrawn()) << seq;
        EXPECT_EQ(answer->payload, exact) << seq;
        ack(viewer, answer->sequence);
        EXPECT_FALSE(view->takeFrame(watcher, Clock::now()).has_value()) << seq;
    }
    EXPECT_EQ(view->counts().drawsAsked, before.drawsAsked);
    EXPECT_EQ(view->counts().encodes, before.encodes);
    look(viewer, 7, 6.0);
    EXPECT_EQ(view->counts().drawsAsked, before.drawsAsked + 1);
    drawLast();
    const auto moved = frameOf(viewer);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(moved->header.input_seq(), 7U);
    EXPECT_TRUE(moved->header.redrawn());
}

// Before the exact picture is there, the answer is the JPEG once more; the exact one still follows.
TEST_F(SharedViewTest, AnUpdateThatChangesNothingDoesNotPutOffTheExactPicture) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    drawLast();
    const auto jpeg = frameOf(viewer);
    ASSERT_TRUE(jpeg.has_value());
    ack(viewer, jpeg->sequence);
    look(viewer, 3, 5.0);
    const auto again = frameOf(viewer);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->header.input_seq(), 3U);
    ack(viewer, again->sequence);
    const auto exact = again->header.final() ? again : frameOf(viewer);
    ASSERT_TRUE(exact.has_value());
    EXPECT_TRUE(exact->header.final());
    EXPECT_EQ(exact->header.input_seq(), 3U);
    EXPECT_EQ(view->counts().drawsAsked, 2U);  // The first as it joined.
}

TEST_F(SharedViewTest, WhatIsBeingDrawnAnswersAnUpdateThatChangesNothing) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    look(viewer, 3, 5.0);
    drawLast();
    const auto frame = frameOf(viewer);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.input_seq(), 3U);
}

TEST_F(SharedViewTest, AnUpdateThatChangesNothingLeavesWhatMayBeRedone) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    v1::Undo undo;
    view->undo(viewer, undo, Clock::now());
    drawLast();
    const auto scene = newest().scene;
    ASSERT_TRUE(frameOf(viewer).has_value());
    v1::Update whole;
    whole.set_input_seq(4);
    *whole.mutable_scene() = worker::toMessage(scene);
    ASSERT_TRUE(view->update(viewer, whole, Clock::now()).has_value());
    undo.set_redo(true);
    view->undo(viewer, undo, Clock::now());
    EXPECT_EQ(newest().scene.camera.eye.x, 5.0);
}

TEST_F(SharedViewTest, ASizeOfItsOwnIsSaved) {
    const ViewerId viewer = join();
    drawLast();
    const int before = saves;
    v1::Update update;
    update.set_input_seq(2);
    update.mutable_viewport()->set_width(16);
    update.mutable_viewport()->set_height(12);
    ASSERT_TRUE(view->update(viewer, update, Clock::now()).has_value());
    EXPECT_GT(saves, before);
}

TEST_F(SharedViewTest, AnUpdateThatChangesNothingWhileThePictureIsDrawnLeavesWhatMayBeRedone) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    v1::Undo undo;
    view->undo(viewer, undo, Clock::now());
    v1::Update whole;
    whole.set_input_seq(4);
    *whole.mutable_scene() = worker::toMessage(newest().scene);
    ASSERT_TRUE(view->update(viewer, whole, Clock::now()).has_value());
    undo.set_redo(true);
    view->undo(viewer, undo, Clock::now());
    EXPECT_EQ(newest().scene.camera.eye.x, 5.0);
}

}  // namespace
}  // namespace volcast::session
