#include "server/session/wire.h"

#include <google/protobuf/util/json_util.h>

namespace volcast::session {

Result<v1::ClientMessage> readMessage(std::span<const std::byte> bytes, Form form) {
    v1::ClientMessage message;
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    if (form == Form::kBinary) {
        if (!message.ParseFromArray(text, static_cast<int>(bytes.size()))) {
            return fail(
                ErrorCode::kInvalidArgument,
                "the message of " + std::to_string(bytes.size()) + " bytes is not a ClientMessage");
        }
        return message;
    }
    const auto status = google::protobuf::util::JsonStringToMessage({text, bytes.size()}, &message);
    if (!status.ok()) {
        return fail(ErrorCode::kInvalidArgument,
                    "the text is not a ClientMessage: " + std::string{status.message()});
    }
    return message;
}

std::string writeMessage(const v1::ServerMessage& message, Form form) {
    std::string bytes;
    if (form == Form::kBinary) {
        message.SerializeToString(&bytes);
        return bytes;
    }
    google::protobuf::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    (void)google::protobuf::util::MessageToJsonString(message, &bytes, options);
    return bytes;
}

v1::ErrorCode wireCode(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::kInvalidArgument: return v1::ERROR_CODE_INVALID_ARGUMENT;
        case ErrorCode::kNotFound: return v1::ERROR_CODE_NOT_FOUND;
        case ErrorCode::kUnsupported: return v1::ERROR_CODE_UNSUPPORTED;
        case ErrorCode::kLimitExceeded: return v1::ERROR_CODE_LIMIT_EXCEEDED;
        case ErrorCode::kOutOfGpuMemory: return v1::ERROR_CODE_OUT_OF_GPU_MEMORY;
        case ErrorCode::kDeviceLost: return v1::ERROR_CODE_WORKER_LOST;
        case ErrorCode::kTimeout: return v1::ERROR_CODE_TIMEOUT;
        case ErrorCode::kIo:
        case ErrorCode::kShaderBuild: break;
    }
    return v1::ERROR_CODE_RENDER_FAILED;
}

v1::ServerMessage errorMessage(v1::ErrorCode code, const std::string& text,
                               const ErrorContext& about, const std::string& field) {
    v1::ServerMessage message;
    v1::Error& error = *message.mutable_error();
    error.set_code(code);
    error.set_message(text);
    error.set_field(field);
    error.set_view(about.view);
    error.set_input_seq(about.inputSeq);
    error.set_dataset(about.dataset);
    return message;
}

v1::ServerMessage errorMessage(const Error& error, const ErrorContext& about) {
    return errorMessage(wireCode(error.code), error.message, about, error.field);
}

v1::ServerMessage statusMessage(std::uint32_t view, v1::ViewState state, const std::string& text) {
    v1::ServerMessage message;
    v1::ViewStatus& status = *message.mutable_view_status();
    status.set_view(view);
    status.set_state(state);
    status.set_message(text);
    return message;
}

}  // namespace volcast::session
