#include "server/session/catalogue.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/unit/session/scripted_render.h"

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

/// A folder whose files the test lists, and whose every look takes as long as the test says.
class CatalogueTest : public testing::Test {
protected:
    void SetUp() override {
        CatalogueDesc desc;
        desc.folder = folder.path().string();
        desc.importer = test::importCube;
        desc.now = [this] { return now; };
        desc.scanner = [this](const std::string&, const base::FileDescriptor&) {
            ++looks;
            now += lookTakes;
            return files;
        };
        auto made = Catalogue::create(std::move(desc), render);
        ASSERT_TRUE(made.has_value()) << made.error().message;
        catalogue = std::move(*made);
        ASSERT_EQ(looks, 1);
    }
    [[nodiscard]] std::optional<ErrorCode> open(const std::string& id) const {
        const auto info = catalogue->open(id);
        return info ? std::nullopt : std::optional{info.error().code};
    }

    support::TemporaryFolder folder;
    test::ScriptedRender render;
    std::vector<FoundDataset> files{{"old.vtu", "old.vtu", 1}};
    std::chrono::steady_clock::time_point now{std::chrono::hours{1}};
    milliseconds lookTakes{20};
    int looks = 0;
    std::unique_ptr<Catalogue> catalogue;
};

TEST_F(CatalogueTest, WhoAsksThousandsOfTimesHasTheFolderLookedIntoOnceARest) {
    for (int i = 0; i < 4000; ++i) {
        ASSERT_EQ(open("missing.vtu"), ErrorCode::kNotFound);
        ASSERT_FALSE(catalogue->require("missing.vtu").has_value());
        ASSERT_EQ(open("old.vtu"), std::nullopt);
    }
    EXPECT_EQ(looks, 1);
    now += milliseconds{200};
    for (int i = 0; i < 4000; ++i) ASSERT_EQ(open("missing.vtu"), ErrorCode::kNotFound);
    EXPECT_EQ(looks, 2);
}

TEST_F(CatalogueTest, AFileThatWasJustPutThereIsFoundAfterTheRest) {
    files.push_back({"new.vtu", "new.vtu", 1});
    now += milliseconds{199};
    EXPECT_EQ(open("new.vtu"), ErrorCode::kNotFound);
    EXPECT_EQ(catalogue->list().datasets_size(), 1);
    now += milliseconds{1};
    EXPECT_EQ(open("new.vtu"), std::nullopt);
    files.push_back({"newer.vtu", "newer.vtu", 1});
    now += milliseconds{200};
    EXPECT_TRUE(catalogue->require("newer.vtu").has_value());
    EXPECT_EQ(catalogue->list().datasets_size(), 3);
    EXPECT_EQ(looks, 3);
}

TEST_F(CatalogueTest, TheRestIsNoLongerThanASecond) {
    lookTakes = std::chrono::seconds{5};
    now += milliseconds{200};
    EXPECT_EQ(open("missing.vtu"), ErrorCode::kNotFound);
    EXPECT_EQ(looks, 2);
    files.push_back({"new.vtu", "new.vtu", 1});
    now += milliseconds{1000};
    EXPECT_EQ(open("new.vtu"), std::nullopt);
}

TEST_F(CatalogueTest, AnUploadIsListedAtOnce) {
    files.push_back({"new.vtu", "new.vtu", 1});
    catalogue->refresh();
    EXPECT_EQ(open("new.vtu"), std::nullopt);
    EXPECT_EQ(looks, 2);
}

// The list is there for others while somebody looks into a slow folder.
TEST_F(CatalogueTest, WhoLooksHoldsUpNobodyWhoDoesNot) {
    CatalogueDesc desc;
    desc.folder = folder.path().string();
    desc.importer = test::importCube;
    std::unique_ptr<Catalogue> other;
    bool asked = false;
    desc.scanner = [&](const std::string&, const base::FileDescriptor&) {
        if (other) asked = !other->standing("old.vtu").loaded && !other->importing();
        return files;
    };
    other = *Catalogue::create(std::move(desc), render);
    other->refresh();
    EXPECT_TRUE(asked);
}

}  // namespace
}  // namespace volcast::session
