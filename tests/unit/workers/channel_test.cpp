#include "renderer/worker/channel.h"

#include <array>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "renderer/base/memfd.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {
namespace {

using internal::v1::ToWorker;
using std::chrono::milliseconds;

constexpr milliseconds kPatience{20'000};

struct Ends {
    Channel a, b;
};

Ends makeEnds() {
    auto pair = Channel::createPair();
    EXPECT_TRUE(pair.has_value());
    return {.a = std::move(pair->ours), .b = Channel{std::move(pair->theirs)}};
}

ToWorker ping(std::uint64_t token) {
    ToWorker message;
    message.mutable_ping()->set_token(token);
    return message;
}

TEST(Channel, KeepsMessagesWholeAndInOrder) {
    Ends ends = makeEnds();
    for (std::uint64_t i = 1; i <= 100; ++i) ASSERT_TRUE(ends.a.send(ping(i)).has_value());
    for (std::uint64_t i = 1; i <= 100; ++i) {
        ToWorker message;
        const auto received = ends.b.receive(message, kPatience);
        ASSERT_TRUE(received.has_value() && received->has_value());
        EXPECT_EQ(message.ping().token(), i);
    }
}

TEST(Channel, HandsDescriptorsOver) {
    Ends ends = makeEnds();
    const auto memory = base::createMemfd("test", 4096);
    ASSERT_TRUE(memory.has_value());
    base::map(*memory, true)->bytes[7] = std::byte{42};
    ASSERT_TRUE(ends.a.send(ping(1), {memory->get(), memory->get()}).has_value());
    ToWorker message;
    auto received = ends.b.receive(message, kPatience);
    ASSERT_TRUE(received.has_value() && received->has_value());
    ASSERT_EQ((*received)->size(), 2U);
    EXPECT_NE((**received)[0].get(), memory->get());
    EXPECT_EQ(base::map((**received)[1], false)->bytes[7], std::byte{42});
}

TEST(Channel, WaitsOnlyAsLongAsItIsTold) {
    Ends ends = makeEnds();
    ToWorker message;
    const auto received = ends.b.receive(message, milliseconds{10});
    ASSERT_TRUE(received.has_value());
    EXPECT_FALSE(received->has_value());
}

TEST(Channel, DeliversWhatWasSentBeforeTheOtherEndClosed) {
    Ends ends = makeEnds();
    ASSERT_TRUE(ends.a.send(ping(5)).has_value());
    { const Channel closed = std::move(ends.a); }
    ToWorker message;
    ASSERT_TRUE(ends.b.receive(message, kPatience)->has_value());
    EXPECT_EQ(message.ping().token(), 5U);
    const auto second = ends.b.receive(message, kPatience);
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().code, ErrorCode::kDeviceLost);
    const auto sent = ends.b.send(ping(6));
    ASSERT_FALSE(sent.has_value());
    EXPECT_EQ(sent.error().code, ErrorCode::kDeviceLost);
}

TEST(Channel, CarriesItsLargestMessageAndRefusesALargerOne) {
    Ends ends = makeEnds();
    ToWorker message;
    message.mutable_add_dataset()->set_id(std::string(kMaxChannelMessage - 16, 'x'));
    ASSERT_TRUE(ends.a.send(message).has_value());
    ToWorker received;
    ASSERT_TRUE(ends.b.receive(received, kPatience)->has_value());
    EXPECT_EQ(received.add_dataset().id(), message.add_dataset().id());
    message.mutable_add_dataset()->set_id(std::string(kMaxChannelMessage, 'x'));
    const auto sent = ends.a.send(message);
    ASSERT_FALSE(sent.has_value());
    EXPECT_EQ(sent.error().code, ErrorCode::kLimitExceeded);
}

TEST(Channel, RefusesTooManyDescriptorsAndEmptyMessages) {
    Ends ends = makeEnds();
    EXPECT_EQ(ends.a.send(ping(1), {0, 0, 0, 0, 0}).error().code, ErrorCode::kLimitExceeded);
    EXPECT_EQ(ends.a.send(ToWorker{}).error().code, ErrorCode::kInvalidArgument);
}

TEST(Channel, RefusesBytesThatAreNoMessage) {
    Ends ends = makeEnds();
    const std::array<char, 5> garbage{'\x0a', '\xff', '\xff', '\xff', '\x7f'};
    ASSERT_EQ(::send(ends.a.fd(), garbage.data(), garbage.size(), 0), 5);
    ToWorker message;
    const auto received = ends.b.receive(message, kPatience);
    ASSERT_FALSE(received.has_value());
    EXPECT_EQ(received.error().code, ErrorCode::kInvalidArgument);
}

TEST(Channel, TrySendNeverWaitsForAReaderThatDoesNotRead) {
    Ends ends = makeEnds();
    ToWorker message;
    message.mutable_add_dataset()->set_id(std::string(60'000, 'x'));
    int sent = 0;
    while (*ends.a.trySend(message)) ++sent;
    EXPECT_GT(sent, 0);
    ToWorker received;
    for (int i = 0; i < sent; ++i) ASSERT_TRUE(ends.b.receive(received, kPatience)->has_value());
    EXPECT_TRUE(*ends.a.trySend(message));
}

}  // namespace
}  // namespace volcast::worker
