#pragma once

#include <string>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::session {

/// Whether symbolic links may be followed; those that lead out of the folder never are.
enum class Links { kFollowInside, kRefuse };

/// Opens a folder as the root for openBeneath().
///
/// Errors: kNotFound, kInvalidArgument (not a folder), kIo (not readable), each with the path.
Result<base::FileDescriptor> openFolder(const std::string& path);

/// Opens `path`, relative to `folder`, for reading, a name at a time from the folder that
/// was reached: no link, no ".." and nothing that is moved meanwhile leads out of it.
///
/// A FIFO opens at once, whether somebody writes to it or not.
///
/// Errors: kNotFound (missing, no name that a file can have, a socket, or leads out), kIo (not
/// readable).
Result<base::FileDescriptor> openBeneath(const base::FileDescriptor& folder,
                                         const std::string& path, Links links);

}  // namespace volcast::session
