#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "renderer/base/result.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// How one connection spells its messages.
enum class Form { kBinary, kJson };

/// Reads one message of a client.
///
/// Errors: kInvalidArgument saying what does not parse; an unknown JSON field is named.
Result<v1::ClientMessage> readMessage(std::span<const std::byte> bytes, Form form);

/// One message to a client; JSON spells out fields that are zero.
std::string writeMessage(const v1::ServerMessage& message, Form form);

/// The stable code of an error; the only place that knows both sets.
v1::ErrorCode wireCode(ErrorCode code) noexcept;

/// What an error is about; zero and empty mean nothing.
struct ErrorContext {
    std::uint32_t view = 0;
    std::uint64_t inputSeq = 0;
    std::string dataset = {};
};

v1::ServerMessage errorMessage(v1::ErrorCode code, const std::string& text,
                               const ErrorContext& about = {}, const std::string& field = {});
v1::ServerMessage errorMessage(const Error& error, const ErrorContext& about);
v1::ServerMessage statusMessage(std::uint32_t view, v1::ViewState state, const std::string& text);

}  // namespace volcast::session
