// The chain of a TIFF file's pages.
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include "renderer/base/file_descriptor.h"
#include "renderer/data/load/tiff_pages.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const base::FileDescriptor file{::memfd_create("tiff", MFD_CLOEXEC)};
    if (::write(file.get(), data, size) != static_cast<ssize_t>(size)) return 0;
    constexpr int kMost = 1000;
    const auto pages = data::load::tiffPages("/proc/self/fd/" + std::to_string(file.get()), kMost);
    fuzz::require(!pages || (*pages >= 0 && *pages <= kMost));
    return 0;
}
