#include "server/session/scene_history.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

SceneHistory::ScenePtr sceneAt(double x) {
    auto scene = std::make_shared<scene::Scene>();
    scene->camera.eye.x = x;
    return scene;
}

/// Plays a view: what it shows, and its history.
class SceneHistoryTest : public testing::Test {
protected:
    void change(double x, bool cameraOnly, milliseconds later) {
        now += later;
        history.changed(current, cameraOnly, now);
        current = sceneAt(x);
    }
    bool undo() { return take(history.undo(current)); }
    bool redo() { return take(history.redo(current)); }
    bool take(SceneHistory::ScenePtr scene) {
        if (!scene) return false;
        current = std::move(scene);
        return true;
    }
    SceneHistory history;
    SceneHistory::ScenePtr current = sceneAt(0);
    TimePoint now{std::chrono::hours{1}};
};

TEST_F(SceneHistoryTest, ADragIsOneStep) {
    for (int i = 1; i <= 50; ++i) change(i, true, milliseconds{16});
    change(51, true, SceneHistory::kPause);
    ASSERT_TRUE(undo());
    EXPECT_EQ(current->camera.eye.x, 50);
    ASSERT_TRUE(undo());
    EXPECT_EQ(current->camera.eye.x, 0);
    EXPECT_FALSE(undo());
    ASSERT_TRUE(redo());
    ASSERT_TRUE(redo());
    EXPECT_EQ(current->camera.eye.x, 51);
    EXPECT_FALSE(redo());
}

TEST_F(SceneHistoryTest, AnotherKindOfChangeBeginsAStep) {
    change(1, true, milliseconds{1});
    change(2, false, milliseconds{1});
    ASSERT_TRUE(undo());
    EXPECT_EQ(current->camera.eye.x, 1);
}

TEST_F(SceneHistoryTest, AChangeAfterUndoForgetsWhatWasUndone) {
    change(1, false, milliseconds{600});
    change(2, false, milliseconds{600});
    ASSERT_TRUE(undo());
    change(3, false, milliseconds{1});
    EXPECT_FALSE(history.canRedo());
    ASSERT_TRUE(undo());
    EXPECT_EQ(current->camera.eye.x, 1) << "the step before the undo does not go on";
}

TEST_F(SceneHistoryTest, TheOldestStepsAreForgotten) {
    for (std::size_t i = 1; i <= SceneHistory::kMostSteps + 7; ++i) {
        change(static_cast<double>(i), false, milliseconds{600});
    }
    std::size_t steps = 0;
    while (undo()) ++steps;
    EXPECT_EQ(steps, SceneHistory::kMostSteps);
    EXPECT_EQ(current->camera.eye.x, 7);
}

TEST_F(SceneHistoryTest, TheNewestStepsAreSavedAndGoneBackToAfterwards) {
    for (int i = 1; i <= 30; ++i) change(i, true, SceneHistory::kPause);
    ASSERT_TRUE(undo());
    ASSERT_TRUE(undo());
    const SceneHistory::Saved saved = history.save();
    EXPECT_EQ(saved.undo.size(), SceneHistory::kMostSaved);
    EXPECT_EQ(saved.redo.size(), 2U);
    history = {};
    EXPECT_FALSE(history.canUndo());
    history.restore(saved);
    ASSERT_TRUE(redo());
    EXPECT_EQ(current->camera.eye.x, 29);
    for (std::size_t i = 0; i <= SceneHistory::kMostSaved; ++i) ASSERT_TRUE(undo()) << i;
    EXPECT_EQ(current->camera.eye.x, 8);
    EXPECT_FALSE(undo());
}

}  // namespace
}  // namespace volcast::session
