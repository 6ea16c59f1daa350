#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::gpu {

/// Sizes a device can work with.
struct DeviceLimits {
    int textureSide = 0;    ///< Pixels, 2D.
    int texture3DSide = 0;  ///< Voxels, 3D.
    std::int64_t texelBufferTexels = 0;
    std::int64_t uniformBlockBytes = 0;
    std::int64_t storageBlockBytes = 0;
    int viewportSide = 0;
};

/// What was found; plain text and numbers for `doctor` and logs.
struct DeviceInfo {
    std::string platform;  ///< "surfaceless" or "device 0 (/dev/dri/renderD128)".
    std::string eglVendor, eglVersion;
    std::string glVendor, glRenderer, glVersion, glslVersion;
    bool robust = false;    ///< The context reports resets and checks array bounds.
    bool software = false;  ///< Rasterised by the CPU.
    DeviceLimits limits;
};

/// One EGL device as the driver lists it.
struct EglDeviceInfo {
    int index = 0;
    std::string path;  ///< Such as /dev/dri/renderD128; empty for a software device.
    bool software = false;
};

/// What EGL offers before any display is opened.
struct EglListing {
    bool surfaceless = false;  ///< EGL_MESA_platform_surfaceless.
    bool devices = false;      ///< EGL_EXT_platform_device.
    std::string clientExtensions;
    std::vector<EglDeviceInfo> deviceList;
};

/// Lists what EGL offers; opens no context.
EglListing listEgl();

struct DeviceDesc {
    /// Empty: surfaceless, else the first EGL device. "0", "1", ...: an EGL device by its index.
    /// "/dev/...": the EGL device with that file.
    std::string gpu;
};

/// Work done so far on one device.
struct Counters {
    std::uint64_t bufferUploads = 0;
    std::uint64_t textureUploads = 0;
    std::uint64_t uploadedBytes = 0;
    std::uint64_t programsBuilt = 0;
    std::uint64_t drawCalls = 0;  ///< Draws and dispatches.
};

enum class ResetStatus { kNone, kGuilty, kInnocent, kUnknown };

enum class Primitive { kTriangles, kPoints };

/// Owns one EGL context (GL 4.5 core, no surface), current on the thread that created it.
///
/// Window coordinates start at the top left and clip-space depth runs over [0, 1], so that row 0
/// of every texture drawn into is the top of the picture. Everything made on a device must go
/// before it; after abandon() such objects forget their names without a GL call.
class Device {
public:
    /// Errors: kNotFound (no such EGL device), kUnsupported (no EGL, no GL 4.5 core).
    static Result<std::unique_ptr<Device>> create(const DeviceDesc& desc = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    Device(Device&&) = delete;
    Device& operator=(Device&&) = delete;

    /// False once abandoned: no GL call may follow.
    [[nodiscard]] bool alive() const noexcept { return alive_; }
    /// Gives the context up, as after a reset; GPU objects become empty shells.
    void abandon() noexcept;
    [[nodiscard]] bool onDeviceThread() const noexcept {
        return std::this_thread::get_id() == thread_;
    }

    [[nodiscard]] const DeviceInfo& info() const noexcept { return info_; }
    [[nodiscard]] const DeviceLimits& limits() const noexcept { return info_.limits; }

    /// Drivers have been seen to answer garbage: only the defined values count as a reset.
    [[nodiscard]] ResetStatus resetStatus() const noexcept;

    /// Turns pending GL errors and a reset into an Error that names `what`.
    ///
    /// Errors: kOutOfGpuMemory, kDeviceLost, kUnsupported (any other GL error: our own mistake or
    /// the driver's).
    Result<void> check(const std::string& what);

    /// Draws without vertex arrays (shaders read buffers by gl_VertexID) with the bound program.
    void draw(Primitive primitive, int vertices, int instances = 1);
    void dispatch(unsigned groupsX, unsigned groupsY, unsigned groupsZ);

    /// Blocks until all work so far is done.
    void finish();

    [[nodiscard]] const Counters& counters() const noexcept { return counters_; }
    [[nodiscard]] Counters& counters() noexcept { return counters_; }

private:
    Device() = default;
    Result<void> open(const DeviceDesc& desc);
    Result<void> makeContext();
    void describe(const std::string& platform);

    void* display_ = nullptr;
    void* context_ = nullptr;
    unsigned vertexArray_ = 0;
    bool alive_ = false;
    bool robust_ = false;
    std::thread::id thread_;
    DeviceInfo info_;
    Counters counters_;
};

}  // namespace volcast::gpu
