#include "protocol/framing.h"

#include <gtest/gtest.h>

namespace volcast::protocol {
namespace {

// Counted by hand from the table in protocol/README.md.
TEST(Framing, ThePrefixIsLittleEndianAt16FixedBytes) {
    const auto bytes = encode({.version = 1,
                               .type = 1,
                               .flags = 0x0201,
                               .headerBytes = 0x06050403,
                               .view = 0x0a090807,
                               .sequence = 0x0e0d0c0b});
    const std::array<unsigned char, 16> expected{1, 1, 1, 2,  3,  4,  5,  6,
                                                 7, 8, 9, 10, 11, 12, 13, 14};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        EXPECT_EQ(std::to_integer<unsigned>(bytes[i]), expected[i]) << "byte " << i;
    }
}

TEST(Framing, AHeadAndItsPayloadComeBackInBothForms) {
    v1::FrameHeader header;
    header.set_input_seq(77);
    header.set_plan_id("p");
    for (const bool json : {false, true}) {
        std::vector<std::byte> message = encodeFrameHead(3, 9, header, json);
        message.push_back(std::byte{0xab});
        const auto frame = decodeFrame(message);
        ASSERT_TRUE(frame.has_value()) << frame.error().message;
        EXPECT_EQ(frame->prefix.view, 3U);
        EXPECT_EQ(frame->prefix.sequence, 9U);
        EXPECT_EQ((frame->prefix.flags & kJsonHeaderFlag) != 0, json);
        EXPECT_EQ(frame->header.input_seq(), 77U);
        EXPECT_EQ(frame->header.plan_id(), "p");
        ASSERT_EQ(frame->payload.size(), 1U);
        EXPECT_EQ(frame->payload[0], std::byte{0xab});
    }
}

// A reader of JSON headers must not have to know the defaults of protobuf.
TEST(Framing, AJsonHeaderSpellsOutFieldsThatAreZeroOrFalse) {
    const auto message = encodeFrameHead(1, 1, {}, true);
    const std::string text{reinterpret_cast<const char*>(message.data()) + kPrefixBytes,
                           message.size() - kPrefixBytes};
    EXPECT_NE(text.find(R"("lossless":false)"), std::string::npos) << text;
    EXPECT_NE(text.find(R"("inputSeq":"0")"), std::string::npos) << text;
}

TEST(Framing, EveryCutOfAFrameIsEitherRefusedOrAShorterPayload) {
    v1::FrameHeader header;
    header.set_plan_id("abcdef");
    std::vector<std::byte> message = encodeFrameHead(1, 1, header, false);
    const std::size_t head = message.size();
    message.resize(head + 4);
    for (std::size_t length = 0; length <= message.size(); ++length) {
        const auto frame = decodeFrame(std::span{message}.first(length));
        EXPECT_EQ(frame.has_value(), length >= head) << length;
        if (frame.has_value()) {
            EXPECT_EQ(frame->payload.size(), length - head);
        }
    }
}

}  // namespace
}  // namespace volcast::protocol
