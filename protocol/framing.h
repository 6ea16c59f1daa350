#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/result.h"
#include "volcast/v1/frame.pb.h"

namespace volcast::protocol {

inline constexpr std::uint32_t kMajor = 1;
inline constexpr std::uint32_t kMinor = 3;
inline constexpr std::size_t kPrefixBytes = 16;
inline constexpr std::uint8_t kFrameType = 1;

/// Header encoding, bit 0 of the prefix's flags: 0 protobuf binary, 1 protobuf JSON.
inline constexpr std::uint16_t kJsonHeaderFlag = 1;

/// The fixed little-endian prefix of a frame: version u8, type u8, flags u16, header length u32,
/// view u32, sequence u32.
struct FramePrefix {
    std::uint8_t version = kMajor;
    std::uint8_t type = kFrameType;
    std::uint16_t flags = 0;
    std::uint32_t headerBytes = 0;
    std::uint32_t view = 0;
    std::uint32_t sequence = 0;
    friend bool operator==(const FramePrefix&, const FramePrefix&) = default;
};

std::array<std::byte, kPrefixBytes> encode(const FramePrefix& prefix);

/// Errors: kInvalidArgument (short, another version or type, header longer than the message).
Result<FramePrefix> decodePrefix(std::span<const std::byte> message);

/// Prefix and header of a frame; the payload is sent behind it as it is.
///
/// `json` makes the header JSON, for connections that speak JSON.
std::vector<std::byte> encodeFrameHead(std::uint32_t view, std::uint32_t sequence,
                                       const v1::FrameHeader& header, bool json);

/// A frame taken apart; `payload` views the message.
struct Frame {
    FramePrefix prefix;
    v1::FrameHeader header;
    std::span<const std::byte> payload;
};

/// Errors: as decodePrefix, and kInvalidArgument for a header that does not parse.
Result<Frame> decodeFrame(std::span<const std::byte> message);

}  // namespace volcast::protocol
