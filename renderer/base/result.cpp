#include "renderer/base/result.h"

#include <stdexcept>

namespace volcast {

void throw_exception_from_error(const Error& error, const boost::source_location& where) {
    throw std::logic_error(std::string{"unchecked error at "} + where.file_name() + ":" +
                           std::to_string(where.line()) + ": " + error.message);
}

const char* name(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::kInvalidArgument: return "invalid_argument";
        case ErrorCode::kNotFound: return "not_found";
        case ErrorCode::kUnsupported: return "unsupported";
        case ErrorCode::kIo: return "io";
        case ErrorCode::kLimitExceeded: return "limit_exceeded";
        case ErrorCode::kShaderBuild: return "shader_build";
        case ErrorCode::kOutOfGpuMemory: return "out_of_gpu_memory";
        case ErrorCode::kDeviceLost: return "device_lost";
        case ErrorCode::kTimeout: return "timeout";
    }
    return "unknown";
}

}  // namespace volcast
