#include "server/session/upload_folder.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace volcast::session {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* kToken = "0123456789abcdef";
constexpr const char* kOther = "fedcba9876543210";

class Uploads : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "volcast-uploads-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        data = name;
        limits.keepFreeBytes = 0;
    }
    void TearDown() override { fs::remove_all(data); }
    void open() {
        folder.reset();
        auto made = UploadFolder::create(data, limits);
        ASSERT_TRUE(made.has_value()) << made.error().message;
        folder = std::move(*made);
    }
    std::optional<UploadError> send(const std::string& name, const std::string& text = "x",
                                    const std::string& token = kToken) const {
        auto file = folder->begin(token, name, text.size());
        if (!file) return file.error();
        if (const auto wrote = (*file)->write(std::as_bytes(std::span{text})); !wrote) {
            return wrote.error();
        }
        const auto finished = (*file)->finish();
        return finished ? std::nullopt : std::optional{finished.error()};
    }
    [[nodiscard]] std::vector<std::string> names(const std::string& of = "uploads") const {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator{data / of}) {
            all.push_back(entry.path().filename().string());
        }
        return all;
    }
    fs::path data;
    UploadLimits limits;
    std::unique_ptr<UploadFolder> folder;
};

TEST_F(Uploads, BecomeAFolderOfTheirOwnWhenAllIsThere) {
    open();
    EXPECT_FALSE(send("cube.node"));
    EXPECT_FALSE(send("cube.ele"));
    EXPECT_THAT(names(), ElementsAre("." + std::string{kToken}));
    const auto ids = folder->finish(kToken, "my cube");
    ASSERT_TRUE(ids.has_value());
    EXPECT_THAT(*ids, ElementsAre("uploads/my cube/cube.node"));
    EXPECT_THAT(names("uploads/my cube"), UnorderedElementsAre("cube.node", "cube.ele"));
}

TEST_F(Uploads, AStackIsOneDatasetAndANameThatIsTakenGetsANumber) {
    open();
    for (int i = 1; i <= 2; ++i) {
        EXPECT_FALSE(send("a1.tif"));
        EXPECT_FALSE(send("a2.tif"));
        const auto ids = folder->finish(kToken, "scan");
        ASSERT_TRUE(ids.has_value());
        EXPECT_THAT(*ids, ElementsAre(i == 1 ? "uploads/scan" : "uploads/scan-2"));
    }
}

TEST_F(Uploads, NamesThatArePathsHiddenOrUnreadableAreRefused) {
    open();
    const std::vector<std::string> bad{"",         ".",        "..",        ".hidden",
                                       "../x",     "a/b.vtu",  "/etc/x",    "a\\b.vtu",
                                       "a\nb.vtu", "\xff.vtu", "a\x7f.vtu", std::string(201, 'a')};
    for (const std::string& name : bad) {
        const auto error = send(name);
        ASSERT_TRUE(error.has_value()) << name;
        EXPECT_EQ(error->why, UploadRefusal::kBadName) << name;
        EXPECT_THAT(error->message, HasSubstr("name"));
    }
    for (const char* token : {"", "short", "../../../../../../etc", "0123456789abcde/"}) {
        EXPECT_EQ(send("a.vtu", "x", token)->why, UploadRefusal::kBadName) << token;
    }
    EXPECT_THAT(names(), ElementsAre());
    EXPECT_FALSE(send("a.vtu"));
    EXPECT_EQ(folder->finish(kToken, "../out").error().why, UploadRefusal::kBadName);
    EXPECT_FALSE(send("größe 1 (b), #2 = x.vtu"));
}

TEST_F(Uploads, SizesAreRefusedBeforeAndWhileTheyAreSent) {
    limits.maxBytes = 100;
    open();
    EXPECT_EQ(folder->begin(kToken, "a.vtu", 101).error().why, UploadRefusal::kTooLarge);
    EXPECT_THAT(names(), ElementsAre()) << "nothing is left of it";
    EXPECT_FALSE(send("a.vtu", std::string(60, 'a')));
    const auto second = send("b.vtu", std::string(41, 'b'));
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->why, UploadRefusal::kTooLarge);
    EXPECT_THAT(second->message, HasSubstr("--max-upload-mb"));
    auto unannounced = folder->begin(kToken, "c.vtu", std::nullopt);
    ASSERT_TRUE(unannounced.has_value());
    const std::string text(41, 'c');
    EXPECT_EQ((*unannounced)->write(std::as_bytes(std::span{text})).error().why,
              UploadRefusal::kTooLarge);
    unannounced->reset();
    EXPECT_THAT(names("uploads/." + std::string{kToken}), ElementsAre("a.vtu"));
    EXPECT_FALSE(send("d.vtu", std::string(40, 'd'))) << "what was refused takes no room";
}

TEST_F(Uploads, CountsHaveLimits) {
    limits.maxFiles = 2;
    limits.maxUploads = 2;
    limits.maxAtOnce = 1;
    open();
    EXPECT_FALSE(send("a.vtu"));
    EXPECT_FALSE(send("b.vtu"));
    EXPECT_EQ(send("c.vtu")->why, UploadRefusal::kTooLarge);
    ASSERT_TRUE(folder->finish(kToken, "one").has_value());
    {
        const auto held = folder->begin(kOther, "a.vtu", 1);
        ASSERT_TRUE(held.has_value());
        EXPECT_EQ(send("b.vtu", "x", kOther)->why, UploadRefusal::kBusy);
    }
    EXPECT_FALSE(send("b.vtu", "x", kOther));
    EXPECT_EQ(send("a.vtu")->why, UploadRefusal::kNoRoom);
    EXPECT_TRUE(folder->cancel(kOther).has_value());
    EXPECT_FALSE(send("a.vtu"));
}

// What earlier runs left counts, and what somebody removed by hand does not.
TEST_F(Uploads, AllOfThemTogetherHaveALimit) {
    limits.maxTotalBytes = 100;
    fs::create_directories(data / "uploads/old");
    std::ofstream{data / "uploads/old/a.vtu"} << std::string(80, 'a');
    open();
    const auto error = send("b.vtu", std::string(21, 'b'));
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->why, UploadRefusal::kNoRoom);
    EXPECT_THAT(error->message, HasSubstr("--max-uploads-mb"));
    fs::remove_all(data / "uploads/old");
    EXPECT_FALSE(send("b.vtu", std::string(21, 'b')));
}

TEST_F(Uploads, TheDiskIsNotFilled) {
    limits.keepFreeBytes = std::uint64_t{1} << 62;
    open();
    const auto error = send("a.vtu");
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->why, UploadRefusal::kNoRoom);
    EXPECT_THAT(error->message, HasSubstr("--upload-keep-free-mb"));
}

TEST_F(Uploads, AFileThatWasNotSentToItsEndIsGone) {
    open();
    {
        auto file = folder->begin(kToken, "a.vtu", 10);
        ASSERT_TRUE(file.has_value());
        EXPECT_TRUE((*file)->write(std::as_bytes(std::span{"half", 4})).has_value());
        EXPECT_EQ(folder->begin(kToken, "a.vtu", 10).error().why, UploadRefusal::kConflict);
        EXPECT_EQ(folder->finish(kToken, "x").error().why, UploadRefusal::kConflict);
    }
    EXPECT_THAT(names("uploads/." + std::string{kToken}), ElementsAre());
    EXPECT_FALSE(send("a.vtu"));
    EXPECT_EQ(send("a.vtu")->why, UploadRefusal::kConflict) << "a name is given once";
}

TEST_F(Uploads, CancellingEndsFilesThatAreBeingReceived) {
    open();
    auto file = folder->begin(kToken, "a.vtu", 10);
    ASSERT_TRUE(file.has_value());
    EXPECT_TRUE(folder->cancel(kToken).has_value());
    EXPECT_EQ((*file)->write(std::as_bytes(std::span{"half", 4})).error().why,
              UploadRefusal::kNotFound);
    file->reset();
    EXPECT_THAT(names(), ElementsAre());
    EXPECT_EQ(folder->cancel(kToken).error().why, UploadRefusal::kNotFound);
    EXPECT_EQ(folder->finish(kToken, "x").error().why, UploadRefusal::kNotFound);
}

TEST_F(Uploads, FilesThatNoLoaderTakesAreNoDataset) {
    open();
    EXPECT_FALSE(send("letter.doc"));
    const auto error = folder->finish(kToken, "letter").error();
    EXPECT_EQ(error.why, UploadRefusal::kNothingToRead);
    EXPECT_THAT(error.message, HasSubstr("letter"));
}

TEST_F(Uploads, WhatAnEarlierServerLeftUnfinishedIsRemoved) {
    open();
    EXPECT_FALSE(send("a.vtu"));
    EXPECT_FALSE(send("a.vtu", "x", kOther));
    ASSERT_TRUE(folder->finish(kOther, "kept").has_value());
    open();
    EXPECT_THAT(names(), ElementsAre("kept"));
}

TEST_F(Uploads, LinksLeadNowhere) {
    fs::create_directory(data / "elsewhere");
    fs::create_directory_symlink("elsewhere", data / "uploads");
    EXPECT_EQ(UploadFolder::create(data, limits).error().code, ErrorCode::kIo);
    fs::remove(data / "uploads");
    open();
    fs::create_directory_symlink("../elsewhere", data / "uploads" / ("." + std::string{kToken}));
    EXPECT_TRUE(send("a.vtu").has_value());
    EXPECT_THAT(names("elsewhere"), ElementsAre());
    // Nor is a link followed that lies where a finished upload would.
    fs::create_directory_symlink("../elsewhere", data / "uploads/x");
    EXPECT_FALSE(send("a.vtu", "x", kOther));
    const auto ids = folder->finish(kOther, "x");
    ASSERT_TRUE(ids.has_value());
    EXPECT_THAT(*ids, ElementsAre("uploads/x-2/a.vtu"));
}

TEST_F(Uploads, AFolderThatCannotBeWrittenIsNamed) {
    std::ofstream{data / "uploads"} << "a file";
    const auto made = UploadFolder::create(data, limits);
    ASSERT_FALSE(made.has_value());
    EXPECT_THAT(made.error().message, HasSubstr("uploads"));
    EXPECT_EQ(UploadFolder::create(data / "missing", limits).error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace volcast::session
