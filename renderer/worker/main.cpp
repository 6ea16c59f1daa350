// volcast-worker: owns one GL context, draws what `volcast` asks for, and trusts nobody.
#include <chrono>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <span>
#include <string>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "renderer/base/forbidden.h"
#include "renderer/base/printable.h"
#include "renderer/base/sandbox.h"
#include "renderer/base/software_gpu.h"
#include "renderer/base/subordinate.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/render.h"
#include "renderer/shading/assemble.h"
#include "renderer/worker/channel.h"
#include "renderer/worker/faults.h"
#include "renderer/worker/frame_message.h"
#include "renderer/worker/loop.h"
#include "renderer/worker/options.h"
#include "renderer/worker/probe.h"

namespace {

using namespace volcast;
using Clock = std::chrono::steady_clock;

/// Tells the server why this worker cannot start.
int refuse(worker::Channel& channel, const Error& error, worker::ExitCode code) {
    spdlog::debug(R"(event=no_start error="{}")", base::printable(error.message, 1000));
    internal::v1::FromWorker message;
    *message.mutable_failed() = worker::toMessage(error);
    static_cast<void>(channel.send(message));  // A server that is gone needs no reason.
    return code;
}

/// Files a GL driver needs, and nothing of the user's.
base::SandboxPolicy sandboxPolicy(const worker::Options& options) {
    constexpr std::uint64_t kMaxCacheFile = std::uint64_t{256} << 20;
    base::SandboxPolicy policy{
        .readable = {"/usr", "/lib", "/lib64", "/etc/ld.so.cache", "/etc/drirc", "/etc/glvnd",
                     "/etc/egl", "/etc/nvidia", "/sys", "/proc/self", "/proc/cpuinfo",
                     "/proc/meminfo", "/proc/driver/nvidia", "/dev/urandom"},
        .writable = {"/dev/dri", "/dev/nvidiactl", "/dev/nvidia-modeset", "/dev/nvidia-uvm",
                     "/dev/nvidia-uvm-tools", "/dev/nvidia-caps", "/dev/kfd", "/dev/null"},
        .mayExecute = false,
        .mayUseThreads = true,
        .maxAddressSpaceBytes = 0,
        .maxFileBytes = kMaxCacheFile,
        .maxCpuSeconds = 0};
    constexpr int kMaxGpus = 32;
    for (int i = 0; i < kMaxGpus; ++i) {
        policy.writable.push_back("/dev/nvidia" + std::to_string(i));
    }
    if (!options.cacheFolder.empty()) policy.writable.push_back(options.cacheFolder);
    if (!options.shaderFolder.empty()) policy.readable.push_back(options.shaderFolder);
    return policy;
}

/// 1 where something was let through.
int tryForbidden(const worker::Options& options) {
    if (Result<void> inside = base::enterSandbox(sandboxPolicy(options)); !inside) {
        spdlog::error(R"(event=no_sandbox error="{}")", base::printable(inside.error().message));
        return worker::kExitSandbox;
    }
    const std::vector<base::Tried> all = base::tryForbidden("/tmp");
    std::fputs(base::report(all).c_str(), stdout);
    return base::allRefused(all) ? 0 : 1;
}

int serve(const worker::Options& options, Clock::time_point start) {
    worker::Channel channel{base::FileDescriptor{worker::kChannelFd}};
    // Before GL is touched: its threads are then inside as well, and drivers are not trusted more
    // than shaders are.
    if (Result<void> inside = base::enterSandbox(sandboxPolicy(options)); !inside) {
        return refuse(channel, inside.error(), worker::kExitSandbox);
    }
    const bool software = options.gpu == base::kSoftwareGpu;
    if (options.fault && losesGpuAtStart(*options.fault) && !software) {
        return worker::kExitDeviceLost;
    }
    auto device = gpu::Device::create({.gpu = options.gpu});
    if (!device) return refuse(channel, device.error(), worker::kExitNoDevice);
    const shading::ChunkSource chunks = options.shaderFolder.empty()
                                            ? shading::embeddedChunks()
                                            : shading::chunksFrom(options.shaderFolder);
    auto renderer =
        scene::Renderer::create(**device, chunks, {.volumeBytes = options.volumeBudgetBytes});
    if (!renderer) return refuse(channel, renderer.error(), worker::kExitNoDevice);
    internal::v1::FromWorker ready;
    const gpu::DeviceInfo& info = (*device)->info();
    ready.mutable_ready()->set_gl_renderer(info.glRenderer);
    ready.mutable_ready()->set_gl_version(info.glVersion);
    ready.mutable_ready()->set_software(info.software);
    ready.mutable_ready()->set_start_ms(
        std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    worker::Loop loop{channel, **device, **renderer, options.cacheFolder};
    if (options.fault && !(software && options.fault->fault == worker::Fault::kLoseGpu)) {
        if (auto armed = loop.arm(*options.fault); !armed) {
            return refuse(channel, armed.error(), worker::kExitUsage);
        }
        if (options.fault->fault == worker::Fault::kLoseGpu) {
            ready.mutable_ready()->set_software(false);
        }
    }
    if (!channel.send(ready)) return worker::kExitDone;
    return loop.run();
}

}  // namespace

int main(int argc, char** argv) {
    const auto start = Clock::now();
    // The channel closes when the server dies; this is for a worker that is busy then.
    base::becomeSubordinate();
    try {
        spdlog::set_default_logger(spdlog::stderr_logger_st("worker"));
        spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v worker=%P");
        const auto options = worker::parseOptions({argv, static_cast<std::size_t>(argc)});
        if (!options) {
            std::fprintf(stderr, "volcast-worker: %s\n", options.error().message.c_str());
            return worker::kExitUsage;
        }
        if (options->help || options->listFaults) {
            std::fputs(options->help ? worker::kHelp : worker::faultList().c_str(), stdout);
            return worker::kExitDone;
        }
        if (options->tryForbidden) return tryForbidden(*options);
        if (options->probe) {
            std::puts(worker::probe(options->gpu).c_str());
            return worker::kExitDone;
        }
        if (::fcntl(worker::kChannelFd, F_GETFD) < 0) {
            std::fputs("volcast-worker is started by volcast and has no use alone\n", stderr);
            return worker::kExitUsage;
        }
        return serve(*options, start);
    } catch (const std::exception& error) {
        spdlog::critical(R"(event=exception error="{}")", base::printable(error.what(), 1000));
        return worker::kExitException;
    }
}
