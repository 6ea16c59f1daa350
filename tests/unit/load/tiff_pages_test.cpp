#include "renderer/data/load/tiff_pages.h"

#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace volcast::data::load {
namespace {

class TiffPages : public testing::Test {
protected:
    /// A little-endian file whose directories are empty but for the way to the next.
    std::string write(const std::vector<std::uint32_t>& next) {
        std::string bytes{"II*\0", 4};
        const auto put = [&bytes](std::uint32_t value, std::size_t size) {
            std::string part(size, '\0');
            std::memcpy(part.data(), &value, size);
            bytes += part;
        };
        put(8, 4);
        for (const std::uint32_t offset : next) {
            put(0, 2);
            put(offset, 4);
        }
        const std::string path = folder_.path() / "pages.tif";
        std::ofstream{path, std::ios::binary} << bytes;
        return path;
    }
    support::TemporaryFolder folder_;
};

TEST_F(TiffPages, AreThoseOfTheChain) {
    EXPECT_EQ(*tiffPages(write({14, 20, 0}), 3), 3);
    EXPECT_EQ(*tiffPages(write({0}), 3), 1);
}

TEST_F(TiffPages, MoreThanTheLimitAreRefused) {
    const auto pages = tiffPages(write({14, 20, 0}), 2);
    ASSERT_FALSE(pages.has_value());
    EXPECT_EQ(pages.error().code, ErrorCode::kLimitExceeded);
    EXPECT_NE(pages.error().message.find("pages.tif: has more than 2 pages"), std::string::npos)
        << pages.error().message;
}

TEST_F(TiffPages, AChainThatLeadsBackEndsAtTheLimit) {
    const auto pages = tiffPages(write({14, 8}), 1 << 15);
    ASSERT_FALSE(pages.has_value());
    EXPECT_EQ(pages.error().code, ErrorCode::kLimitExceeded);
}

TEST_F(TiffPages, AChainThatLeavesTheFileIsCutOff) {
    const auto pages = tiffPages(write({14, 999}), 9);
    ASSERT_FALSE(pages.has_value());
    EXPECT_EQ(pages.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(pages.error().message.find("page 2 lies behind its end"), std::string::npos)
        << pages.error().message;
}

TEST_F(TiffPages, AHeaderMayBeCutOffToo) {
    const std::string path = folder_.path() / "short.tif";
    std::ofstream{path} << "II*";
    const auto pages = tiffPages(path, 9);
    ASSERT_FALSE(pages.has_value());
    EXPECT_EQ(pages.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(tiffPages(folder_.path() / "none.tif", 9).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace volcast::data::load
