#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <boost/json.hpp>
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "protocol/framing.h"
#include "tests/unit/protocol/vector_cases.h"
#include "volcast/v1/session.pb.h"

namespace volcast::protocol {
namespace {

using google::protobuf::util::JsonStringToMessage;
using google::protobuf::util::MessageDifferencer;

std::string committedFile() {
    std::ifstream file{VOLCAST_SOURCE_DIR "/protocol/vectors/vectors.json"};
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The committed rows of one kind; their bytes and meanings do not pass through vector_cases.cpp.
std::vector<VectorCase> committed(const std::string& kind) {
    std::vector<VectorCase> cases;
    const boost::json::value file = boost::json::parse(committedFile());
    for (const auto& row : file.as_array()) {
        if (row.at("kind").as_string() != kind) continue;
        cases.push_back({std::string{row.at("name").as_string()}, kind,
                         std::string{row.at("hex").as_string()},
                         boost::json::serialize(row.at("json"))});
    }
    return cases;
}

/// Bytes and JSON of every row of `kind` mean the same message, in both directions.
template <class Message>
void expectSameMeaning(const std::string& kind, std::size_t atLeast) {
    const auto cases = committed(kind);
    EXPECT_GE(cases.size(), atLeast);
    for (const VectorCase& one : cases) {
        SCOPED_TRACE(one.name);
        const auto bytes = bytesFromHex(one.hex);
        Message fromBytes, fromJson;
        ASSERT_TRUE(fromBytes.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())));
        ASSERT_TRUE(JsonStringToMessage(one.json, &fromJson).ok());
        EXPECT_TRUE(MessageDifferencer::Equals(fromBytes, fromJson));
        const std::string again = fromJson.SerializeAsString();
        EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span{again}), bytes));
    }
}

// Set VOLCAST_WRITE_VECTORS to a path to write the file anew after a change of the messages.
TEST(Vectors, TheCommittedFileIsWhatThisBuildMakes) {
    const std::string made = vectorsFile(makeVectors());
    if (const char* path = std::getenv("VOLCAST_WRITE_VECTORS")) std::ofstream{path} << made;
    EXPECT_EQ(committedFile(), made);
}

TEST(Vectors, ClientMessagesMeanWhatTheirJsonSays) {
    expectSameMeaning<v1::ClientMessage>("client", 12);
}

TEST(Vectors, ServerMessagesMeanWhatTheirJsonSays) {
    expectSameMeaning<v1::ServerMessage>("server", 12);
}

TEST(Vectors, FramesAreTakenApartAsTheirJsonSays) {
    const auto cases = committed("frame");
    EXPECT_GE(cases.size(), 7U);
    for (const VectorCase& one : cases) {
        SCOPED_TRACE(one.name);
        const auto json = boost::json::parse(one.json);
        const auto bytes = bytesFromHex(one.hex);
        const auto frame = decodeFrame(bytes);
        ASSERT_TRUE(frame.has_value()) << frame.error().message;
        EXPECT_EQ(frame->prefix.flags, json.at("flags").to_number<std::uint32_t>());
        EXPECT_EQ(frame->prefix.headerBytes, json.at("headerBytes").to_number<std::uint32_t>());
        EXPECT_EQ(frame->prefix.view, json.at("view").to_number<std::uint32_t>());
        EXPECT_EQ(frame->prefix.sequence, json.at("sequence").to_number<std::uint32_t>());
        v1::FrameHeader header;
        ASSERT_TRUE(JsonStringToMessage(boost::json::serialize(json.at("header")), &header).ok());
        v1::FrameHeader read = frame->header;
        read.DiscardUnknownFields();
        EXPECT_TRUE(MessageDifferencer::Equals(read, header)) << frame->header.DebugString();
        EXPECT_TRUE(std::ranges::equal(frame->payload,
                                       bytesFromHex(std::string{json.at("payload").as_string()})));
    }
}

TEST(Vectors, InvalidFramesAreRefused) {
    const auto cases = committed("invalid_frame");
    EXPECT_GE(cases.size(), 10U);
    for (const VectorCase& one : cases) {
        const auto frame = decodeFrame(bytesFromHex(one.hex));
        ASSERT_FALSE(frame.has_value()) << one.name;
        EXPECT_EQ(frame.error().code, ErrorCode::kInvalidArgument) << one.name;
        EXPECT_THAT(frame.error().message, testing::StartsWith("frame: ")) << one.name;
    }
}

}  // namespace
}  // namespace volcast::protocol
