#include "renderer/gpu/driver_faults.h"

#include <csignal>
#include <cstdlib>
#include <unistd.h>

#include <epoxy/gl.h>

namespace volcast::gpu {
namespace {

/// More than any GPU has, and still a positive GLsizeiptr.
constexpr GLsizeiptr kTooManyBytes = GLsizeiptr{1} << 60;

[[noreturn]] void hang() {
    for (;;) ::pause();
}

[[noreturn]] void crash() {
    std::signal(SIGSEGV, SIG_DFL);  // A sanitizer would report it as a finding.
    std::raise(SIGSEGV);
    std::abort();  // Never reached.
}

/// Stands in the place of one entry of libepoxy's table of GL functions, until it has struck.
template <auto& Entry>
struct Detour;

template <class Return, class... Arguments, Return (*&Entry)(Arguments...)>
struct Detour<Entry> {
    using Function = Return (*)(Arguments...);

    static void set(Function fault, std::uint32_t after) {
        fault_ = fault;
        left_ = after;
        if (Entry != &call) driver_ = Entry;
        Entry = &call;
    }

    static Return call(Arguments... arguments) {
        Entry = driver_;
        if (left_ == 0) return fault_(arguments...);
        --left_;
        const Again again;
        return driver_(arguments...);
    }

private:
    /// The first call of a function makes libepoxy look it up and fill its table.
    struct Again {
        Again() = default;
        Again(const Again&) = delete;
        Again& operator=(const Again&) = delete;
        Again(Again&&) = delete;
        Again& operator=(Again&&) = delete;
        ~Again() {
            driver_ = Entry;
            Entry = &call;
        }
    };

    inline static Function driver_ = nullptr;
    inline static Function fault_ = nullptr;
    inline static std::uint32_t left_ = 0;
};

using Draw = Detour<epoxy_glDrawArraysInstanced>;
using Link = Detour<epoxy_glLinkProgram>;
using Fill = Detour<epoxy_glNamedBufferSubData>;
using Allocate = Detour<epoxy_glNamedBufferStorage>;
using Status = Detour<epoxy_glGetGraphicsResetStatus>;
using Read = Detour<epoxy_glReadPixels>;

}  // namespace

void injectDriverFault(DriverFault fault, std::uint32_t after) {
    switch (fault) {
        case DriverFault::kCrashInDraw:
            return Draw::set([](GLenum, GLint, GLsizei, GLsizei) { crash(); }, after);
        case DriverFault::kHangInDraw:
            return Draw::set([](GLenum, GLint, GLsizei, GLsizei) { hang(); }, after);
        case DriverFault::kHangInLink: return Link::set([](GLuint) { hang(); }, after);
        case DriverFault::kExitInUpload:
            return Fill::set(
                [](GLuint, GLintptr, GLsizeiptr, const void*) { ::_exit(EXIT_FAILURE); }, after);
        case DriverFault::kOutOfMemory:
            return Allocate::set(
                [](GLuint buffer, GLsizeiptr, const void*, GLbitfield flags) {
                    glNamedBufferStorage(buffer, kTooManyBytes, nullptr, flags);
                },
                after);
        case DriverFault::kReset:
            return Status::set([]() -> GLenum { return GL_GUILTY_CONTEXT_RESET; }, after);
        case DriverFault::kReadsNothing:
            return Read::set([](GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*) {}, after);
    }
}

}  // namespace volcast::gpu
