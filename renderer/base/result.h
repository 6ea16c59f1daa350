#pragma once

#include <string>
#include <utility>

#include <boost/system/result.hpp>

namespace volcast {

/// What kind of thing went wrong; the server maps it to the wire's stable codes.
enum class ErrorCode {
    kInvalidArgument,
    kNotFound,
    kUnsupported,
    kIo,
    kLimitExceeded,
    kShaderBuild,
    kOutOfGpuMemory,
    kDeviceLost,
    kTimeout,
};

/// A failure of the world (bad file, bad request, lost device), never of our own logic.
struct Error {
    ErrorCode code = ErrorCode::kInvalidArgument;
    std::string message;  ///< For a human: names the object, the value and the limit.
    std::string field;    ///< Path of the field at fault, such as "layers[0].field"; may be empty.
};

/// Thrown only by value() on an error, which is our own bug: check has_value() first.
[[noreturn]] void throw_exception_from_error(  // NOLINT(readability-identifier-naming)
    const Error& error, const boost::source_location& where);

template <class T>
using Result = boost::system::result<T, Error>;

/// Shorthand for the error branch: `return fail(ErrorCode::kIo, path + ": is empty");`
[[nodiscard]] inline Error fail(ErrorCode code, std::string message, std::string field = {}) {
    return Error{.code = code, .message = std::move(message), .field = std::move(field)};
}

/// The code's name as it is logged and tested, such as "invalid_argument".
[[nodiscard]] const char* name(ErrorCode code) noexcept;

}  // namespace volcast
