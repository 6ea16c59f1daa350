#include "server/session/catalogue.h"

#include <thread>

#include <gtest/gtest.h>

#include "renderer/base/memfd.h"
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

/// Datasets "1" to "9", of as many MiB, where 9 MiB may be loaded.
class CatalogueRoom : public testing::Test {
protected:
    void SetUp() override {
        CatalogueDesc desc;
        desc.folder = folder.path().string();
        desc.maxDataBytes = std::uint64_t{9} << 20U;
        desc.importer = [](const workers::ImportRequest& request, const auto& settings,
                           const auto& progress) {
            auto imported = test::importCube(request, settings, progress);
            const auto mib = std::stoul(request.path.substr(request.path.rfind('/') + 1));
            imported->packed = *base::createMemfd("cube", mib << 20U);
            return imported;
        };
        desc.scanner = [](const std::string&, const base::FileDescriptor&) {
            std::vector<FoundDataset> all;
            for (const char* id : {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}) {
                all.push_back({id, id, 1});
            }
            return all;
        };
        catalogue = *Catalogue::create(std::move(desc), render);
    }
    /// Asks for it; the error where it cannot be loaded.
    std::string load(const std::string& id) {
        EXPECT_TRUE(catalogue->require(id).has_value());
        while (!catalogue->standing(id).loaded && !catalogue->standing(id).failed) {
            std::this_thread::yield();
        }
        return catalogue->standing(id).error;
    }
    [[nodiscard]] bool loaded(const std::string& id) const {
        return catalogue->standing(id).loaded;
    }
    [[nodiscard]] v1::DatasetInfo info(const std::string& id) {
        const v1::DatasetList list = catalogue->list();
        for (const v1::DatasetInfo& one : list.datasets()) {
            if (one.id() == id) return one;
        }
        return {};
    }
    support::TemporaryFolder folder;
    test::ScriptedRender render;
    std::unique_ptr<Catalogue> catalogue;
};

TEST_F(CatalogueRoom, WhatWasNotAskedForTheLongestIsLetGoAndImportedAgainWhenItIs) {
    for (const char* id : {"2", "3", "4"}) EXPECT_EQ(load(id), "");
    EXPECT_EQ(render.removed, std::vector<std::string>{}) << "9 MiB fit";
    EXPECT_EQ(load("2"), "");
    EXPECT_EQ(load("1"), "");
    EXPECT_EQ(render.removed, std::vector<std::string>{"3"});
    EXPECT_FALSE(loaded("3"));
    EXPECT_EQ(info("3").state(), v1::DATASET_STATE_LISTED);
    EXPECT_EQ(catalogue->summaries({"3"}).size(), 0U);
    EXPECT_EQ(load("3"), "");
    EXPECT_EQ(info("3").version(), 2U) << "numbers are not used twice";
    EXPECT_EQ(render.removed, (std::vector<std::string>{"3", "4"}));
}

TEST_F(CatalogueRoom, WhatSomebodyShowsStays) {
    EXPECT_EQ(load("4"), "");
    EXPECT_EQ(load("3"), "");
    {
        const DatasetHold shown = catalogue->hold({"4", "unknown"});
        EXPECT_EQ(load("5"), "");
        EXPECT_TRUE(loaded("4") && !loaded("3"));
        const std::string why = load("6");
        EXPECT_EQ(why,
                  "6: takes 6 MiB of memory beside 4 MiB of data that views show; the limit is 9 "
                  "MiB (--max-data-mb)");
        EXPECT_TRUE(loaded("4") && loaded("5")) << "nothing is let go in vain";
        EXPECT_EQ(info("6").state(), v1::DATASET_STATE_FAILED);
    }
    EXPECT_EQ(load("9"), "");
    EXPECT_FALSE(loaded("4") || loaded("5"));
}

TEST_F(CatalogueRoom, WhatIsLargerThanTheLimitIsRefusedAndLetsNothingGo) {
    EXPECT_EQ(load("2"), "");
    EXPECT_NE(load("10").find("10 MiB"), std::string::npos);
    EXPECT_TRUE(loaded("2"));
    EXPECT_EQ(load("7"), "") << "what was refused takes no room";
    EXPECT_TRUE(loaded("2"));
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
