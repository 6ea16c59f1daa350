#include "server/session/state_folder.h"

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace volcast::session {
namespace {

namespace fs = std::filesystem;

SavedView exampleView(const std::string& id) {
    SavedView view{.id = id, .shared = true, .inputSeq = (std::uint64_t{1} << 60U) + 1};
    view.scene.camera.eye = {0.1, 1.0 / 3.0, -2e-9};
    scene::Layer& layer = view.scene.layers.emplace_back();
    layer.id = "main";
    layer.dataset = "d";
    layer.field = "f";
    layer.map.points = {{.value = 0.25F}};
    for (const double x : {1.0, 2.0}) {
        scene::Scene before = view.scene;
        before.camera.eye.x = x;
        view.history.undo.push_back(std::make_shared<const scene::Scene>(before));
    }
    view.history.redo = {view.history.undo.back()};
    SavedView::Person& person = view.people.emplace_back();
    person.member.person = 7;
    person.member.name = "Zoë \"Z\"";
    person.member.role = v1::ROLE_CONTROL;
    person.member.number = 3;
    person.member.size = {640, 480};
    person.steers = true;
    person.tokenHash = "hash";
    return view;
}

TEST(SavedView, IsReadAsItWasWritten) {
    const SavedView view = exampleView("v");
    const auto read = savedViewFromJson(toJson(view));
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->id, view.id);
    EXPECT_EQ(read->shared, view.shared);
    EXPECT_EQ(read->inputSeq, view.inputSeq);
    EXPECT_EQ(read->scene, view.scene);
    ASSERT_EQ(read->history.undo.size(), 2U);
    EXPECT_EQ(*read->history.undo[0], *view.history.undo[0]);
    EXPECT_EQ(*read->history.undo[1], *view.history.undo[1]);
    ASSERT_EQ(read->history.redo.size(), 1U);
    EXPECT_EQ(*read->history.redo[0], *view.history.redo[0]);
    ASSERT_EQ(read->people.size(), 1U);
    EXPECT_EQ(read->people[0].member.name, view.people[0].member.name);
    EXPECT_EQ(read->people[0].member.role, v1::ROLE_CONTROL);
    EXPECT_EQ(read->people[0].member.size, view.people[0].member.size);
    EXPECT_TRUE(read->people[0].steers);
    EXPECT_EQ(read->people[0].tokenHash, "hash");
}

TEST(SavedView, OfAServerThatKeptNoHistoryHasNone) {
    SavedView view = exampleView("v");
    view.history = {};
    std::string text = toJson(view);
    const std::string none = R"(,"undo":[],"redo":[])";
    ASSERT_NE(text.find(none), std::string::npos) << text;
    text.erase(text.find(none), none.size());
    const auto read = savedViewFromJson(text);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_TRUE(read->history.undo.empty() && read->history.redo.empty());
}

TEST(SavedView, EveryPrefixAndEveryDamagedByteIsReadOrRefusedButNeverCrashes) {
    const std::string text = toJson(exampleView("v"));
    for (std::size_t size = 0; size + 1 < text.size(); ++size) {
        EXPECT_FALSE(savedViewFromJson(text.substr(0, size)).has_value()) << size;
    }
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string damaged = text;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
        (void)savedViewFromJson(damaged);
    }
}

TEST(StateFolder, KeepsTheNewestOfAViewAndForgetsOneThatEnded) {
    const support::TemporaryFolder folder;
    const std::string path = (folder.path() / "made" / "state").string();
    {
        const auto state = StateFolder::create(path);
        ASSERT_TRUE(state.has_value()) << state.error().message;
        (*state)->begin([](const std::string& id) -> std::optional<SavedView> {
            if (id == "gone") return std::nullopt;
            return exampleView(id);
        });
        for (const char* id : {"one", "two", "gone", "one"}) (*state)->changed(id);
    }  // Writes what waits.
    {
        const auto state = StateFolder::create(path);
        EXPECT_EQ((*state)->load().size(), 2U);
        (*state)->begin([](const std::string&) { return std::optional<SavedView>{}; });
        (*state)->changed("one");
    }
    EXPECT_FALSE(fs::exists(path + "/one.view.json"));
    EXPECT_TRUE(fs::exists(path + "/two.view.json"));
}

/// Counts the views that are asked for.
struct CountedSource {
    std::optional<SavedView> operator()(const std::string& id) {
        const std::lock_guard lock{mutex};
        ++asked[id];
        came.notify_all();
        return exampleView(id);
    }
    void wait(const std::string& id, int count) {
        std::unique_lock lock{mutex};
        EXPECT_TRUE(came.wait_for(lock, std::chrono::seconds{30}, [&] {
            return asked[id] >= count;
        })) << id;
    }
    std::mutex mutex;
    std::condition_variable came;
    std::map<std::string, int> asked;
};

// A folder in the place of the temporary file: the view cannot be written, whoever tries.
TEST(StateFolder, WhatCouldNotBeWrittenIsTriedAgainUntilItCan) {
    const support::TemporaryFolder folder;
    const fs::path file = folder.path() / "one.view.json", block = folder.path() / "one.view.tmp";
    fs::create_directory(block);
    CountedSource source;
    const auto state = StateFolder::create(folder.path().string());
    ASSERT_TRUE(state.has_value());
    (*state)->begin([&](const std::string& id) { return source(id); },
                    std::chrono::milliseconds{1});
    (*state)->changed("one");
    source.wait("one", 3);  // Nobody said again that it changed.
    EXPECT_FALSE(fs::exists(file));
    fs::remove(block);
    (*state)->changed("two");
    source.wait("two", 1);  // Written after "one" was.
    EXPECT_TRUE(fs::exists(file));
}

TEST(StateFolder, TheEndTriesOnceMoreWhatCouldNotBeWritten) {
    const support::TemporaryFolder folder;
    const fs::path file = folder.path() / "one.view.json", block = folder.path() / "one.view.tmp";
    fs::create_directory(block);
    CountedSource source;
    {
        const auto state = StateFolder::create(folder.path().string());
        ASSERT_TRUE(state.has_value());
        (*state)->begin([&](const std::string& id) { return source(id); }, std::chrono::hours{1});
        for (const char* id : {"one", "two"}) (*state)->changed(id);
        source.wait("two", 1);  // Written after "one" was not.
        fs::remove(block);
    }
    EXPECT_TRUE(fs::exists(file));
    EXPECT_EQ(source.asked["two"], 1) << "what is written is not written again";
}

TEST(StateFolder, TheEndDoesNotWaitForAFolderThatStaysFull) {
    const support::TemporaryFolder folder;
    fs::create_directory(folder.path() / "one.view.tmp");
    CountedSource source;
    const auto state = StateFolder::create(folder.path().string());
    ASSERT_TRUE(state.has_value());
    (*state)->begin([&](const std::string& id) { return source(id); });
    (*state)->changed("one");
    (*state)->finish();
    EXPECT_GE(source.asked["one"], 1);
}

TEST(StateFolder, WhatIsDamagedOrForeignIsSkippedAndLeftAlone) {
    const support::TemporaryFolder folder;
    const auto put = [&](const std::string& name, const std::string& text) {
        std::ofstream{folder.path() / name} << text;
    };
    put("good.view.json", toJson(exampleView("good")));
    put("cut.view.json", toJson(exampleView("cut")).substr(0, 100));
    put("renamed.view.json", toJson(exampleView("other")));
    put("empty.view.json", "");
    put("notes.txt", "mine");
    put("half.view.tmp", "{");
    put("link.key", "key");
    put("link.key.Ab-_12.tmp", "half a k");
    fs::create_directory(folder.path() / "folder.view.json");
    fs::create_symlink(folder.path() / "good.view.json", folder.path() / "linked.view.json");
    const auto state = StateFolder::create(folder.path().string());
    ASSERT_TRUE(state.has_value());
    const auto views = (*state)->load();
    ASSERT_EQ(views.size(), 1U);
    EXPECT_EQ(views[0].id, "good");
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator{folder.path()}) files += entry.exists() ? 1 : 0;
    EXPECT_EQ(files, 10U);
}

TEST(StateFolder, AFolderThatCannotBeIsAnErrorThatNamesIt) {
    const support::TemporaryFolder folder;
    std::ofstream{folder.path() / "file"} << "x";
    const auto state = StateFolder::create((folder.path() / "file").string());
    ASSERT_FALSE(state.has_value());
    EXPECT_NE(state.error().message.find("--state-dir"), std::string::npos);
}

}  // namespace
}  // namespace volcast::session
