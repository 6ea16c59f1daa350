#include "renderer/base/file_descriptor.h"

#include <unistd.h>

namespace volcast::base {

FileDescriptor::~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
}

}  // namespace volcast::base
