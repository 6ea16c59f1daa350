#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::base {

/// A shared mapping of a whole memfd. The mapping lives as long as any copy of `owner`.
struct Mapping {
    std::shared_ptr<std::byte> owner;
    std::span<std::byte> bytes;
};

/// Makes an anonymous file of exactly `size` bytes, zero-filled, that can neither shrink nor grow.
///
/// Errors: kInvalidArgument (size 0), kIo (no memory, no descriptors).
Result<FileDescriptor> createMemfd(const char* label, std::size_t size);

/// Forbids all later writes to `fd`; fails (kIo) while a writable shared mapping exists.
Result<void> sealReadOnly(const FileDescriptor& fd);

/// True where neither the content nor the size of `fd` can change any more.
bool isSealedReadOnly(const FileDescriptor& fd) noexcept;

/// Maps all of `fd`. Writable mappings need an fd without a write seal.
///
/// Requires a size that cannot shrink (F_SEAL_SHRINK), so that no access can raise SIGBUS.
/// Errors: kInvalidArgument (empty, or may shrink), kIo.
Result<Mapping> map(const FileDescriptor& fd, bool writable);

}  // namespace volcast::base
