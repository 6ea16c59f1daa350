#include "renderer/base/memfd.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace volcast::base {

namespace {

Error ioError(const std::string& what) {
    return fail(ErrorCode::kIo, what + ": " + std::strerror(errno));
}

constexpr int kSizeSeals = F_SEAL_SHRINK | F_SEAL_GROW;

}  // namespace

Result<FileDescriptor> createMemfd(const char* label, std::size_t size) {
    if (size == 0) return fail(ErrorCode::kInvalidArgument, std::string{label} + ": size is 0");
    FileDescriptor fd{::memfd_create(label, MFD_CLOEXEC | MFD_ALLOW_SEALING)};
    if (!fd.valid()) return ioError(std::string{label} + ": memfd_create");
    if (::ftruncate(fd.get(), static_cast<off_t>(size)) != 0) {
        return ioError(std::string{label} + ": cannot reserve " + std::to_string(size) + " bytes");
    }
    if (::fcntl(fd.get(), F_ADD_SEALS, kSizeSeals) != 0) {
        return ioError(std::string{label} + ": cannot seal the size");
    }
    return fd;
}

Result<void> sealReadOnly(const FileDescriptor& fd) {
    if (::fcntl(fd.get(), F_ADD_SEALS, kSizeSeals | F_SEAL_WRITE) != 0) {
        return ioError("memfd: cannot seal against writing");
    }
    return {};
}

bool isSealedReadOnly(const FileDescriptor& fd) noexcept {
    const int seals = ::fcntl(fd.get(), F_GET_SEALS);
    constexpr int kWanted = kSizeSeals | F_SEAL_WRITE;
    return seals >= 0 && (seals & kWanted) == kWanted;
}

Result<Mapping> map(const FileDescriptor& fd, bool writable) {
    const int seals = ::fcntl(fd.get(), F_GET_SEALS);
    if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) {
        return fail(ErrorCode::kInvalidArgument, "memfd: its size is not sealed");
    }
    struct stat info {};
    if (::fstat(fd.get(), &info) != 0) return ioError("memfd: fstat");
    const auto size = static_cast<std::size_t>(info.st_size);
    if (size == 0) return fail(ErrorCode::kInvalidArgument, "memfd: is empty");
    const int protection = writable ? PROT_READ | PROT_WRITE : PROT_READ;
    void* address = ::mmap(nullptr, size, protection, MAP_SHARED, fd.get(), 0);
    if (address == MAP_FAILED) return ioError("memfd: mmap of " + std::to_string(size) + " bytes");
    auto* bytes = static_cast<std::byte*>(address);
    return Mapping{.owner = {bytes, [size](std::byte* p) { ::munmap(p, size); }},
                   .bytes = {bytes, size}};
}

}  // namespace volcast::base
