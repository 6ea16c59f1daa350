#include "renderer/worker/channel.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace volcast::worker {

namespace {

using Clock = std::chrono::steady_clock;

Error systemError(ErrorCode code, const std::string& what) {
    return fail(code, "worker channel: " + what + ": " + std::strerror(errno));
}

bool isGone(int error) {
    return error == EPIPE || error == ECONNRESET || error == ENOTCONN;
}

/// Room for the descriptors of one message, aligned as the kernel wants it.
struct alignas(cmsghdr) ControlSpace {
    std::array<char, CMSG_SPACE(kMaxChannelDescriptors * sizeof(int))> bytes{};
};

void attach(msghdr& header, ControlSpace& space, const std::vector<int>& descriptors) {
    if (descriptors.empty()) return;
    const std::size_t size = descriptors.size() * sizeof(int);
    header.msg_control = space.bytes.data();
    header.msg_controllen = CMSG_SPACE(size);
    cmsghdr* control = CMSG_FIRSTHDR(&header);
    control->cmsg_level = SOL_SOCKET;
    control->cmsg_type = SCM_RIGHTS;
    control->cmsg_len = CMSG_LEN(size);
    std::memcpy(CMSG_DATA(control), descriptors.data(), size);
}

std::vector<base::FileDescriptor> detach(msghdr& header) {
    std::vector<base::FileDescriptor> descriptors;
    for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr;
         control = CMSG_NXTHDR(&header, control)) {
        if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_RIGHTS) continue;
        const std::size_t count = (control->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (std::size_t i = 0; i < count; ++i) {
            int fd = -1;
            std::memcpy(&fd, CMSG_DATA(control) + i * sizeof(int), sizeof(int));
            descriptors.emplace_back(fd);
        }
    }
    return descriptors;
}

/// True when the socket can be read (or is closed) before `timeout` has passed.
Result<bool> waitReadable(int fd, std::chrono::milliseconds timeout) {
    const bool forEver = timeout.count() < 0;
    const auto until = Clock::now() + (forEver ? std::chrono::milliseconds{0} : timeout);
    for (;;) {
        int waitMs = -1;
        if (!forEver) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
            waitMs = static_cast<int>(std::max<std::int64_t>(left.count(), 0));
        }
        pollfd entry{.fd = fd, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&entry, 1, waitMs);
        if (ready > 0) return true;
        if (ready == 0) return false;
        if (errno != EINTR) return systemError(ErrorCode::kIo, "poll");
    }
}

}  // namespace

Result<Channel::Pair> Channel::createPair() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return systemError(ErrorCode::kIo, "socketpair");
    }
    return Pair{.ours = Channel{base::FileDescriptor{ends[0]}},
                .theirs = base::FileDescriptor{ends[1]}};
}

Result<bool> Channel::sendWith(const google::protobuf::MessageLite& message,
                               const std::vector<int>& descriptors, int flags) {
    const std::size_t size = message.ByteSizeLong();
    if (size == 0) {
        return fail(ErrorCode::kInvalidArgument, "worker channel: the message is empty");
    }
    if (size > kMaxChannelMessage) {
        return fail(ErrorCode::kLimitExceeded, "worker channel: a message of " +
                                                   std::to_string(size) + " bytes is longer than " +
                                                   std::to_string(kMaxChannelMessage));
    }
    if (descriptors.size() > kMaxChannelDescriptors) {
        return fail(ErrorCode::kLimitExceeded,
                    "worker channel: " + std::to_string(descriptors.size()) +
                        " descriptors, at most " + std::to_string(kMaxChannelDescriptors));
    }
    buffer_.resize(size);
    message.SerializeToArray(buffer_.data(), static_cast<int>(size));
    iovec bytes{.iov_base = buffer_.data(), .iov_len = size};
    ControlSpace space;
    msghdr header{};
    header.msg_iov = &bytes;
    header.msg_iovlen = 1;
    attach(header, space, descriptors);
    for (;;) {
        if (::sendmsg(socket_.get(), &header, flags | MSG_NOSIGNAL) >= 0) return true;
        if (errno == EINTR) continue;
        if (errno == EAGAIN || errno == EWOULDBLOCK) return false;
        return systemError(isGone(errno) ? ErrorCode::kDeviceLost : ErrorCode::kIo, "send");
    }
}

Result<void> Channel::send(const google::protobuf::MessageLite& message,
                           const std::vector<int>& descriptors) {
    const Result<bool> sent = sendWith(message, descriptors, 0);
    if (!sent) return sent.error();
    return {};
}

Result<bool> Channel::trySend(const google::protobuf::MessageLite& message,
                              const std::vector<int>& descriptors) {
    return sendWith(message, descriptors, MSG_DONTWAIT);
}

Result<std::optional<std::vector<base::FileDescriptor>>> Channel::receive(
    google::protobuf::MessageLite& message, std::chrono::milliseconds timeout) {
    const Result<bool> readable = waitReadable(socket_.get(), timeout);
    if (!readable) return readable.error();
    if (!*readable) return std::optional<std::vector<base::FileDescriptor>>{};

    buffer_.resize(kMaxChannelMessage);
    iovec bytes{.iov_base = buffer_.data(), .iov_len = buffer_.size()};
    ControlSpace space;
    msghdr header{};
    header.msg_iov = &bytes;
    header.msg_iovlen = 1;
    header.msg_control = space.bytes.data();
    header.msg_controllen = space.bytes.size();
    ssize_t size = -1;
    do {
        size = ::recvmsg(socket_.get(), &header, MSG_CMSG_CLOEXEC);
    } while (size < 0 && errno == EINTR);
    if (size < 0) {
        return systemError(isGone(errno) ? ErrorCode::kDeviceLost : ErrorCode::kIo, "receive");
    }
    std::vector<base::FileDescriptor> descriptors = detach(header);
    if (size == 0) {
        return fail(ErrorCode::kDeviceLost, "worker channel: closed by the other end");
    }
    if ((header.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0) {
        return fail(ErrorCode::kInvalidArgument, "worker channel: a message was cut off");
    }
    if (!message.ParseFromArray(buffer_.data(), static_cast<int>(size))) {
        return fail(
            ErrorCode::kInvalidArgument,
            "worker channel: a message of " + std::to_string(size) + " bytes does not parse");
    }
    return std::optional{std::move(descriptors)};
}

}  // namespace volcast::worker
