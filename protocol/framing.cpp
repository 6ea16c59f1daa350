#include "protocol/framing.h"

#include <algorithm>
#include <string>

#include <google/protobuf/util/json_util.h>

namespace volcast::protocol {

namespace {

template <class T>
void put(std::byte* at, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        at[i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i));
    }
}

template <class T>
T take(const std::byte* at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::uint64_t(at[i]) << (8 * i);
    return static_cast<T>(value);
}

}  // namespace

std::array<std::byte, kPrefixBytes> encode(const FramePrefix& prefix) {
    std::array<std::byte, kPrefixBytes> bytes{};
    put(&bytes[0], prefix.version);
    put(&bytes[1], prefix.type);
    put(&bytes[2], prefix.flags);
    put(&bytes[4], prefix.headerBytes);
    put(&bytes[8], prefix.view);
    put(&bytes[12], prefix.sequence);
    return bytes;
}

Result<FramePrefix> decodePrefix(std::span<const std::byte> message) {
    const auto refuse = [](const std::string& why) {
        return fail(ErrorCode::kInvalidArgument, "frame: " + why);
    };
    if (message.size() < kPrefixBytes) {
        return refuse(std::to_string(message.size()) + " bytes, the prefix alone has " +
                      std::to_string(kPrefixBytes));
    }
    const FramePrefix prefix{.version = take<std::uint8_t>(&message[0]),
                             .type = take<std::uint8_t>(&message[1]),
                             .flags = take<std::uint16_t>(&message[2]),
                             .headerBytes = take<std::uint32_t>(&message[4]),
                             .view = take<std::uint32_t>(&message[8]),
                             .sequence = take<std::uint32_t>(&message[12])};
    if (prefix.version != kMajor) {
        return refuse("version " + std::to_string(prefix.version) + ", expected " +
                      std::to_string(kMajor));
    }
    if (prefix.type != kFrameType) return refuse("type " + std::to_string(prefix.type));
    if (prefix.headerBytes > message.size() - kPrefixBytes) {
        return refuse("header of " + std::to_string(prefix.headerBytes) +
                      " bytes in a message of " + std::to_string(message.size()));
    }
    return prefix;
}

std::vector<std::byte> encodeFrameHead(std::uint32_t view, std::uint32_t sequence,
                                       const v1::FrameHeader& header, bool json) {
    std::string text;
    if (json) {
        google::protobuf::util::JsonPrintOptions options;
        options.always_print_primitive_fields = true;
        (void)google::protobuf::util::MessageToJsonString(header, &text, options);
    } else {
        header.SerializeToString(&text);
    }
    const auto prefix = encode({.flags = json ? kJsonHeaderFlag : std::uint16_t{0},
                                .headerBytes = static_cast<std::uint32_t>(text.size()),
                                .view = view,
                                .sequence = sequence});
    std::vector<std::byte> head(kPrefixBytes + text.size());
    std::ranges::copy(prefix, head.begin());
    std::ranges::copy(std::as_bytes(std::span{text}), head.begin() + kPrefixBytes);
    return head;
}

Result<Frame> decodeFrame(std::span<const std::byte> message) {
    const auto prefix = decodePrefix(message);
    if (!prefix) return prefix.error();
    Frame frame{.prefix = *prefix, .header = {}, .payload = {}};
    const auto head = message.subspan(kPrefixBytes, prefix->headerBytes);
    const auto* text = reinterpret_cast<const char*>(head.data());
    const bool parsed =
        (prefix->flags & kJsonHeaderFlag) != 0
            ? google::protobuf::util::JsonStringToMessage({text, head.size()}, &frame.header).ok()
            : frame.header.ParseFromArray(text, static_cast<int>(head.size()));
    if (!parsed) return fail(ErrorCode::kInvalidArgument, "frame: the header does not parse");
    frame.payload = message.subspan(kPrefixBytes + prefix->headerBytes);
    return frame;
}

}  // namespace volcast::protocol
