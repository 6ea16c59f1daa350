#pragma once

namespace volcast::base {

/// In the place of a GPU's index or file: the first device that EGL calls a software one, such as
/// Mesa's llvmpipe.
inline constexpr const char* kSoftwareGpu = "software";

}  // namespace volcast::base
