// A packed dataset, as an importer that a hostile file took over may send it.
#include <sys/mman.h>
#include <unistd.h>

#include "renderer/base/memfd.h"
#include "renderer/data/packed_dataset.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const base::FileDescriptor file{::memfd_create("packed", MFD_CLOEXEC)};
    if (::write(file.get(), data, size) != static_cast<ssize_t>(size)) return 0;
    (void)data::unpack(file);
    return 0;
}
