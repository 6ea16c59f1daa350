#include "server/workers/gpu_given_up.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace volcast::workers {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;

class GpuGivenUp : public testing::Test {
protected:
    static std::string textOf(const fs::path& path) {
        std::ifstream file{path};
        return {std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
    }

    // NOLINTBEGIN(readability-identifier-naming): a fixture's parts are used like locals
    support::TemporaryFolder folder;
    std::string cache = folder.path() / "cache";
    fs::path note = folder.path() / "cache/gpu_given_up.txt";
    fs::path target = folder.path() / "of_the_user";
    // NOLINTEND(readability-identifier-naming)

    void SetUp() override {
        fs::create_directory(cache);
        std::ofstream{target} << "precious";
    }
};

TEST_F(GpuGivenUp, IsNotedReadAndForgotten) {
    EXPECT_EQ(gpuGivenUp(cache), "");
    noteGpuGivenUp(cache, "lost three workers");
    noteGpuGivenUp(cache, "lost three more");
    EXPECT_THAT(gpuGivenUp(cache), EndsWith("Z: lost three more"));
    EXPECT_EQ(std::distance(fs::directory_iterator{cache}, {}), 1) << "nothing is left beside it";
    forgetGpuGivenUp(cache);
    EXPECT_EQ(gpuGivenUp(cache), "");
}

TEST_F(GpuGivenUp, ALinkInItsPlaceLeavesWhatItLeadsToUntouched) {
    fs::create_symlink(target, note);
    EXPECT_EQ(gpuGivenUp(cache), "") << "it is not read through either";
    noteGpuGivenUp(cache, "lost three workers");
    EXPECT_EQ(textOf(target), "precious");
    EXPECT_FALSE(fs::is_symlink(note));
    EXPECT_THAT(gpuGivenUp(cache), EndsWith("lost three workers"));
    fs::remove(note);
    fs::create_symlink(target, note);
    forgetGpuGivenUp(cache);
    EXPECT_EQ(textOf(target), "precious");
    EXPECT_FALSE(fs::is_symlink(note));
}

TEST_F(GpuGivenUp, WhatIsNoFileIsNoNoteAndIsNotWaitedFor) {
    ASSERT_EQ(::mkfifo(note.c_str(), 0600), 0);
    EXPECT_EQ(gpuGivenUp(cache), "");
    fs::remove(note);
    fs::create_directory(note);
    EXPECT_EQ(gpuGivenUp(cache), "");
    noteGpuGivenUp(cache, "lost three workers");
    EXPECT_EQ(std::distance(fs::directory_iterator{cache}, {}), 1);
}

TEST_F(GpuGivenUp, ANoteWithoutEndIsReadInPart) {
    std::ofstream{note} << 'x';
    fs::resize_file(note, std::uintmax_t{1} << 40);
    EXPECT_LT(gpuGivenUp(cache).size(), 2000U);
}

}  // namespace
}  // namespace volcast::workers
