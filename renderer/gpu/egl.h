#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <epoxy/egl.h>

#include "renderer/base/result.h"

namespace volcast::gpu {

/// An EGL display chosen by DeviceDesc::gpu, and what to call it.
struct OpenDisplay {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string name;
};

/// True where `extensions`, separated by blanks, holds `wanted`.
bool hasExtension(const char* extensions, std::string_view wanted);

/// Opens and initialises a display. Displays belong to the process and are never terminated:
/// EGL does not count their users.
///
/// Errors: kNotFound, kUnsupported.
Result<OpenDisplay> openDisplay(const std::string& gpu);

}  // namespace volcast::gpu
