#pragma once

#include <string>

namespace volcast::worker {

/// What EGL offers and what the device `gpu` (as gpu::DeviceDesc) can do, as JSON text of
/// internal.v1.Probe. A device that cannot be opened is a result, too.
std::string probe(const std::string& gpu);

}  // namespace volcast::worker
