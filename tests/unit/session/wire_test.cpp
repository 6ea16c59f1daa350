#include "server/session/wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using testing::HasSubstr;

std::span<const std::byte> bytesOf(std::string_view text) {
    return std::as_bytes(std::span{text});
}

TEST(Wire, AnUnknownJsonFieldIsNamed) {
    const auto message = readMessage(bytesOf(R"({"update":{"view":1,"nosuch":2}})"), Form::kJson);
    ASSERT_FALSE(message.has_value());
    EXPECT_THAT(message.error().message, HasSubstr("nosuch"));
}

TEST(Wire, NonsenseIsRefusedInBothForms) {
    for (const char* text : {"", "{", "[]", "nonsense", R"({"ping":{"token":"x"}})", "\xff"}) {
        EXPECT_FALSE(readMessage(bytesOf(text), Form::kJson).has_value()) << text;
    }
    EXPECT_FALSE(readMessage(bytesOf("\xff\xff"), Form::kBinary).has_value());
    EXPECT_FALSE(readMessage(bytesOf("\x0a\x7f"), Form::kBinary).has_value());
}

// Braces without end must not cost the stack.
TEST(Wire, DeeplyNestedJsonIsRefused) {
    std::string text;
    for (int i = 0; i < 20'000; ++i) text += R"({"update":)";
    EXPECT_FALSE(readMessage(bytesOf(text), Form::kJson).has_value());
}

TEST(Wire, WhatIsWrittenCanBeReadByTheOtherSide) {
    const auto message = errorMessage(fail(ErrorCode::kLimitExceeded, "too many", "scene.layers"),
                                      {.view = 3, .inputSeq = 9});
    v1::ServerMessage read;
    ASSERT_TRUE(read.ParseFromString(writeMessage(message, Form::kBinary)));
    EXPECT_EQ(read.error().code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_EQ(read.error().field(), "scene.layers");
    const std::string json = writeMessage(message, Form::kJson);
    EXPECT_THAT(json, HasSubstr(R"("code":"ERROR_CODE_LIMIT_EXCEEDED")"));
    EXPECT_THAT(json, HasSubstr(R"("inputSeq":"9")"));
}

TEST(Wire, EveryErrorHasAStableCode) {
    for (int code = 0; code <= static_cast<int>(ErrorCode::kTimeout); ++code) {
        EXPECT_NE(wireCode(static_cast<ErrorCode>(code)), v1::ERROR_CODE_UNSPECIFIED) << code;
    }
    EXPECT_EQ(wireCode(ErrorCode::kDeviceLost), v1::ERROR_CODE_WORKER_LOST);
    EXPECT_EQ(wireCode(ErrorCode::kNotFound), v1::ERROR_CODE_NOT_FOUND);
}

}  // namespace
}  // namespace volcast::session
