#include "server/net/uploads.h"

#include <gtest/gtest.h>

namespace volcast::net {
namespace {

TEST(UploadTarget, IsATokenAndAFileOrAName) {
    const auto file = uploadTargetOf("/v1/uploads/abc/my%20file.vtu");
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(file->token, "abc");
    EXPECT_EQ(file->file, "my file.vtu");
    const auto whole = uploadTargetOf("/v1/uploads/abc?name=a%2Fb%3Fc");
    ASSERT_TRUE(whole.has_value());
    EXPECT_EQ(whole->token, "abc");
    EXPECT_EQ(whole->file, "");
    EXPECT_EQ(whole->name, "a/b?c");
}

// A slash that is escaped is one, too: what is no name is refused where names are checked.
TEST(UploadTarget, KeepsWhatIsBehindTheFirstSlashAsTheFile) {
    EXPECT_EQ(uploadTargetOf("/v1/uploads/abc/..%2f..%2fx")->file, "../../x");
    EXPECT_EQ(uploadTargetOf("/v1/uploads/abc/d/x")->file, "d/x");
}

TEST(UploadTarget, OtherPathsAreRefused) {
    for (const char* target : {"/v1/uploads", "/v1/ws", "/v1/uploads/abc/", "/v1/uploads/%zz",
                               "/v1/uploads/abc?other=1", "/v1/uploads/abc?name=%", "*", ""}) {
        EXPECT_FALSE(uploadTargetOf(target).has_value()) << target;
    }
}

}  // namespace
}  // namespace volcast::net
