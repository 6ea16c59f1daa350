#include "renderer/gpu/egl.h"

#include <array>
#include <charconv>

#include "renderer/base/software_gpu.h"
#include "renderer/gpu/device.h"

namespace volcast::gpu {
namespace {

constexpr int kMaxDevices = 64;
constexpr EGLint kRenderNodeFile =
    0x3377;  // EGL_DRM_RENDER_NODE_FILE_EXT, missing in older headers

// libepoxy decides by the display whether an extension exists, and there is none yet: the
// functions of client extensions are asked for by name.
template <class Function>
Function entry(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

const char* clientExtensions() {
    const char* text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return text == nullptr ? "" : text;
}

std::vector<EGLDeviceEXT> queryDevices() {
    const char* extensions = clientExtensions();
    if (!hasExtension(extensions, "EGL_EXT_device_enumeration") &&
        !hasExtension(extensions, "EGL_EXT_device_base")) {
        return {};
    }
    const auto query = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    std::array<EGLDeviceEXT, kMaxDevices> devices{};
    EGLint count = 0;
    if (query == nullptr || query(kMaxDevices, devices.data(), &count) != EGL_TRUE) return {};
    // Parentheses: in braces, two pointers to handles would themselves become two handles.
    std::vector<EGLDeviceEXT> found(devices.begin(), devices.begin() + count);
    return found;
}

EglDeviceInfo describe(EGLDeviceEXT device, int index) {
    EglDeviceInfo info{.index = index, .path = {}, .software = false};
    const auto query = entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (query == nullptr) return info;
    const char* extensions = query(device, EGL_EXTENSIONS);
    info.software = hasExtension(extensions, "EGL_MESA_device_software");
    for (const auto& [extension, key] :
         {std::pair{"EGL_EXT_device_drm_render_node", kRenderNodeFile},
          std::pair{"EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT}}) {
        if (!info.path.empty() || !hasExtension(extensions, extension)) continue;
        const char* path = query(device, key);
        if (path != nullptr) info.path = path;
    }
    return info;
}

Result<OpenDisplay> initialised(EGLenum platform, void* native, std::string name) {
    const auto open = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (open == nullptr) return fail(ErrorCode::kUnsupported, "EGL has no platform displays");
    const EGLDisplay display = open(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        return fail(ErrorCode::kUnsupported, "EGL cannot initialise the platform " + name);
    }
    return OpenDisplay{.display = display, .name = std::move(name)};
}

Result<OpenDisplay> openDevice(int index) {
    const std::vector<EGLDeviceEXT> devices = queryDevices();
    if (index < 0 || index >= static_cast<int>(devices.size())) {
        return fail(ErrorCode::kNotFound, "GPU " + std::to_string(index) + ": EGL lists " +
                                              std::to_string(devices.size()) + " devices");
    }
    const EglDeviceInfo info = describe(devices[index], index);
    std::string name = "device " + std::to_string(index);
    if (!info.path.empty()) name += " (" + info.path + ")";
    return initialised(EGL_PLATFORM_DEVICE_EXT, devices[index], std::move(name));
}

}  // namespace

bool hasExtension(const char* extensions, std::string_view wanted) {
    if (extensions == nullptr) return false;
    std::string_view rest = extensions;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == wanted) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

EglListing listEgl() {
    EglListing listing;
    listing.clientExtensions = clientExtensions();
    const char* extensions = listing.clientExtensions.c_str();
    listing.surfaceless = hasExtension(extensions, "EGL_MESA_platform_surfaceless");
    listing.devices = hasExtension(extensions, "EGL_EXT_platform_device");
    int index = 0;
    for (EGLDeviceEXT device : queryDevices()) {
        listing.deviceList.push_back(describe(device, index++));
    }
    return listing;
}

Result<OpenDisplay> openDisplay(const std::string& gpu) {
    if (gpu.empty()) {
        if (hasExtension(clientExtensions(), "EGL_MESA_platform_surfaceless")) {
            Result<OpenDisplay> opened =
                initialised(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless");
            if (opened) return opened;
        }
        if (queryDevices().empty()) {
            return fail(ErrorCode::kUnsupported,
                        "no EGL: it offers neither a surfaceless platform nor a device (is an EGL "
                        "driver installed?)");
        }
        return openDevice(0);
    }
    int index = -1;
    const auto [end, error] = std::from_chars(gpu.data(), gpu.data() + gpu.size(), index);
    if (error == std::errc{} && end == gpu.data() + gpu.size()) return openDevice(index);
    for (const EglDeviceInfo& info : listEgl().deviceList) {
        if (gpu == base::kSoftwareGpu ? info.software : info.path == gpu)
            return openDevice(info.index);
    }
    if (gpu == base::kSoftwareGpu) {
        return fail(ErrorCode::kNotFound, "EGL lists no software device (is Mesa installed?)");
    }
    return fail(ErrorCode::kNotFound, "GPU \"" + gpu + "\": no EGL device has that file or index");
}

}  // namespace volcast::gpu
