#include "renderer/data/load/record_stream.h"

#include <array>
#include <cstring>
#include <unistd.h>

#include <gtest/gtest.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::data::load {
namespace {

/// A record as a reader sends it.
std::string record(std::uint32_t kind, std::uint32_t textBytes, std::uint64_t dataBytes,
                   const std::string& rest) {
    std::string bytes(16, '\0');
    std::memcpy(bytes.data(), &kind, 4);
    std::memcpy(bytes.data() + 4, &textBytes, 4);
    std::memcpy(bytes.data() + 8, &dataBytes, 8);
    return bytes + rest;
}

/// The end of a pipe from which `bytes` come, and then nothing.
base::FileDescriptor pipeWith(const std::string& bytes) {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::pipe(ends.data()), 0);
    const base::FileDescriptor writeEnd{ends[1]};
    EXPECT_EQ(::write(writeEnd.get(), bytes.data(), bytes.size()),
              static_cast<ssize_t>(bytes.size()));
    return base::FileDescriptor{ends[0]};
}

TEST(RecordStream, ReadsTextAndValues) {
    const std::array<double, 2> numbers{1.5, -2.0};
    const std::string data{reinterpret_cast<const char*>(numbers.data()), sizeof numbers};
    const auto pipe = pipeWith(record(7, 4, 16, "heat" + data));
    RecordStream stream{pipe.get(), 100};
    const auto got = stream.next();
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->kind, RecordKind::kField);
    EXPECT_EQ(got->text, "heat");
    const auto values = stream.values<double>(*got);
    ASSERT_TRUE(values.has_value());
    EXPECT_EQ(*values, (std::vector<double>{1.5, -2.0}));
    EXPECT_FALSE(stream.next().has_value());
    EXPECT_TRUE(stream.ended());
}

TEST(RecordStream, RefusesWhatAReaderMustNotSend) {
    const std::vector<std::pair<std::string, ErrorCode>> cases{
        {record(0, 0, 0, ""), ErrorCode::kInvalidArgument},
        {record(11, 0, 0, ""), ErrorCode::kInvalidArgument},
        {record(2, 1U << 20, 0, ""), ErrorCode::kInvalidArgument},
        {record(5, 0, std::uint64_t{1} << 60, ""), ErrorCode::kLimitExceeded},
        {record(2, 10, 0, "short"), ErrorCode::kInvalidArgument},
        {"half a header", ErrorCode::kInvalidArgument},
    };
    for (const auto& [bytes, code] : cases) {
        const auto pipe = pipeWith(bytes);
        RecordStream stream{pipe.get(), 1000};
        const auto got = stream.next();
        ASSERT_FALSE(got.has_value());
        EXPECT_EQ(got.error().code, code);
    }
}

TEST(RecordStream, RefusesAPartOfANumberAndMoreThanTheWholeLimit) {
    const auto part = pipeWith(record(5, 0, 12, std::string(12, 'x')));
    RecordStream stream{part.get(), 1000};
    const auto got = stream.next();
    ASSERT_TRUE(got.has_value());
    EXPECT_FALSE(stream.values<double>(*got).has_value());
    const std::string one = record(5, 0, 64, std::string(64, 'x'));
    const auto two = pipeWith(one + one);
    RecordStream limited{two.get(), 100};
    const auto first = limited.next();
    ASSERT_TRUE(first.has_value());
    EXPECT_TRUE(limited.values<double>(*first).has_value());
    EXPECT_EQ(limited.next().error().code, ErrorCode::kLimitExceeded);
}

}  // namespace
}  // namespace volcast::data::load
