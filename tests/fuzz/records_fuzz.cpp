// What a reader in Python, which a hostile file may have taken over, sends through its pipe.
#include <algorithm>
#include <sys/mman.h>
#include <unistd.h>

#include "renderer/base/memfd.h"
#include "renderer/data/load/record_stream.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const base::FileDescriptor file{::memfd_create("records", MFD_CLOEXEC)};
    if (::write(file.get(), data, size) != static_cast<ssize_t>(size)) return 0;
    ::lseek(file.get(), 0, SEEK_SET);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 20U;
    data::load::RecordStream stream{file.get(), kMost};
    for (auto record = stream.next(); record; record = stream.next()) {
        if (!stream.values<std::uint8_t>(*record)) break;
    }
    return 0;
}
