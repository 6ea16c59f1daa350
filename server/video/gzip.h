#pragma once

#include <string>
#include <string_view>

#include "renderer/base/result.h"

namespace volcast::video {

/// `content` as a gzip file (RFC 1952) without name and time, so that the same gives the same.
///
/// Meant for what is compressed once and sent often: libdeflate level 9. Errors: kIo (no memory).
Result<std::string> gzip(std::string_view content);

}  // namespace volcast::video
