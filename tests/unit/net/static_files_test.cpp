#include "server/net/static_files.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <unistd.h>

#include <gtest/gtest.h>
#include <libdeflate.h>

namespace volcast::net {
namespace {

namespace fs = std::filesystem;

class StaticFilesTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "volcast-static-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        base = name;
        fs::create_directories(base / "client/assets");
        std::ofstream{base / "client/index.html"} << "<html>";
        std::ofstream{base / "client/assets/index-1f2e.js"} << "1;";
        std::ofstream{base / "secret"} << "x";
        fs::create_symlink("../secret", base / "client/out");
        fs::create_symlink("index.html", base / "client/in");
    }
    void TearDown() override { fs::remove_all(base); }
    fs::path base;
};

TEST_F(StaticFilesTest, TheRootIsTheIndexAndIsAlwaysRevalidated) {
    const StaticFiles files{base / "client"};
    EXPECT_TRUE(files.built());
    const auto file = files.read("/");
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(file->content, "<html>");
    EXPECT_EQ(file->mimeType, "text/html; charset=utf-8");
    EXPECT_EQ(file->cacheControl, "no-cache");
}

TEST_F(StaticFilesTest, HashedAssetsAreKeptForEver) {
    const auto file = StaticFiles{base / "client"}.read("/assets/index-1f2e.js?x#y");
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(file->mimeType, "text/javascript; charset=utf-8");
    EXPECT_NE(file->cacheControl.find("immutable"), std::string::npos);
}

TEST_F(StaticFilesTest, TheEtagFollowsTheContent) {
    const StaticFiles files{base / "client"};
    const auto before = files.read("/");
    std::ofstream{base / "client/index.html"} << "<html lang=en>";
    const auto after = files.read("/");
    ASSERT_TRUE(before.has_value() && after.has_value());
    EXPECT_NE(before->etag, after->etag);
}

TEST_F(StaticFilesTest, NoPathLeadsOut) {
    const StaticFiles files{base / "client"};
    for (const char* target :
         {"/../secret", "/%2e%2e/secret", "/assets/../../secret", "/..%2fsecret", "//etc/passwd",
          "/out", "/in", "/assets", "/missing", "/%2fetc%2fpasswd", "/."}) {
        const auto file = files.read(target);
        ASSERT_FALSE(file.has_value()) << target;
        EXPECT_EQ(file.error().code, ErrorCode::kNotFound) << target;
    }
    for (const char* target : {"", "*", "http://x/", "/%", "/%4", "/%zz", "/%00", "/a%0ab"}) {
        const auto file = files.read(target);
        ASSERT_FALSE(file.has_value()) << target;
        EXPECT_EQ(file.error().code, ErrorCode::kInvalidArgument) << target;
    }
}

std::string unzipped(const std::string& packed) {
    std::string content(std::size_t{1} << 20U, '\0');
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> with{
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor};
    std::size_t size = 0;
    const auto result = libdeflate_gzip_decompress(with.get(), packed.data(), packed.size(),
                                                   content.data(), content.size(), &size);
    content.resize(result == LIBDEFLATE_SUCCESS ? size : 0);
    return content;
}

TEST_F(StaticFilesTest, TextIsGzippedForThoseWhoTakeItAndPicturesAreNot) {
    const std::string script(5000, ';');
    std::ofstream{base / "client/assets/index-1f2e.js"} << script;
    std::ofstream{base / "client/assets/dot.png"} << script;
    const StaticFiles files{base / "client"};
    const auto plain = files.read("/assets/index-1f2e.js");
    const auto packed = files.read("/assets/index-1f2e.js", true);
    ASSERT_TRUE(plain.has_value() && packed.has_value());
    EXPECT_EQ(plain->content, script);
    EXPECT_FALSE(plain->gzipped);
    EXPECT_TRUE(packed->gzipped);
    EXPECT_EQ(unzipped(packed->content), script);
    EXPECT_TRUE(plain->varies && packed->varies);
    EXPECT_NE(plain->etag, packed->etag);
    EXPECT_EQ(files.read("/assets/index-1f2e.js", true)->content, packed->content);
    const auto picture = files.read("/assets/dot.png", true);
    ASSERT_TRUE(picture.has_value());
    EXPECT_EQ(picture->content, script);
    EXPECT_FALSE(picture->varies);
}

TEST_F(StaticFilesTest, WhatGzipMakesLargerIsSentAsItIs) {
    const auto file = StaticFiles{base / "client"}.read("/assets/index-1f2e.js", true);
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(file->content, "1;");
    EXPECT_FALSE(file->gzipped);
}

TEST_F(StaticFilesTest, AFileThatIsBuiltAgainIsCompressedAgain) {
    const StaticFiles files{base / "client"};
    std::ofstream{base / "client/index.html"} << std::string(4000, 'a');
    const auto before = files.read("/", true);
    std::ofstream{base / "client/index.html"} << std::string(4001, 'b');
    const auto after = files.read("/", true);
    ASSERT_TRUE(before.has_value() && after.has_value());
    EXPECT_EQ(unzipped(after->content), std::string(4001, 'b'));
    EXPECT_NE(before->etag, after->etag);
}

TEST_F(StaticFilesTest, AClientThatIsNotBuiltIsNoError) {
    const StaticFiles files{base / "nowhere"};
    EXPECT_FALSE(files.built());
    EXPECT_EQ(files.read("/").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace volcast::net
