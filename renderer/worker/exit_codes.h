#pragma once

namespace volcast::worker {

/// How `volcast-worker` ends. The server tells these apart from crashes and kills.
enum ExitCode : int {
    kExitDone = 0,        ///< The server closed the channel.
    kExitUsage = 2,       ///< Unknown arguments.
    kExitNoDevice = 3,    ///< No EGL, or no OpenGL 4.5 core; the reason was sent as Failed.
    kExitSandbox = 4,     ///< The sandbox could not be entered.
    kExitDeviceLost = 5,  ///< The GPU was reset or the context is gone.
    kExitProtocol = 6,    ///< The server sent what no server sends.
    kExitException = 7,   ///< Out of memory, or a bug.
};

/// Such as "lost its GPU"; empty for codes that are none of ours.
[[nodiscard]] constexpr const char* describe(int exitCode) noexcept {
    switch (exitCode) {
        case kExitUsage: return "was started with wrong arguments";
        case kExitNoDevice: return "found no usable GL device";
        case kExitSandbox: return "could not enter its sandbox";
        case kExitDeviceLost: return "lost its GL device";
        case kExitProtocol: return "was sent a message it does not know";
        case kExitException: return "ran out of memory or failed inside";
        default: return "";
    }
}

}  // namespace volcast::worker
