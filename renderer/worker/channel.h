#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include <google/protobuf/message_lite.h>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::worker {

/// Descriptor at which a child process finds its end of the channel.
inline constexpr int kChannelFd = 3;
inline constexpr std::size_t kMaxChannelMessage = std::size_t{192} * 1024;
inline constexpr std::size_t kMaxChannelDescriptors = 4;

/// One end of a SOCK_SEQPACKET pair: whole messages, each with up to 4 descriptors.
class Channel {
public:
    struct Pair;
    /// Errors: kIo.
    static Result<Pair> createPair();

    explicit Channel(base::FileDescriptor socket) noexcept : socket_{std::move(socket)} {}

    /// Blocks until sent.
    ///
    /// Errors: kLimitExceeded (too long, too many descriptors), kDeviceLost (the other end is
    /// gone), kInvalidArgument (nothing is set in `message`), kIo.
    Result<void> send(const google::protobuf::MessageLite& message,
                      const std::vector<int>& descriptors = {});

    /// As send(), but never waits: false where the other end has not read enough yet.
    Result<bool> trySend(const google::protobuf::MessageLite& message,
                         const std::vector<int>& descriptors = {});

    /// Waits up to `timeout` (negative: for ever) and parses one message.
    ///
    /// Empty on a timeout. Errors: kDeviceLost (closed), kInvalidArgument (does not parse), kIo.
    Result<std::optional<std::vector<base::FileDescriptor>>> receive(
        google::protobuf::MessageLite& message, std::chrono::milliseconds timeout);

    [[nodiscard]] int fd() const noexcept { return socket_.get(); }

private:
    Result<bool> sendWith(const google::protobuf::MessageLite& message,
                          const std::vector<int>& descriptors, int flags);

    base::FileDescriptor socket_;
    std::vector<char> buffer_;  ///< Of the next message, either way.
};

struct Channel::Pair {
    Channel ours;
    base::FileDescriptor theirs;
};

}  // namespace volcast::worker
