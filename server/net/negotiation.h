#pragma once

#include <string_view>

namespace volcast::net {

/// Whether an Accept-Encoding header lets gzip in: named, or by "*", and not with q=0 (RFC 9110,
/// section 12.5.3).
bool acceptsGzip(std::string_view acceptEncoding);

/// Whether an If-None-Match header names `etag` (RFC 9110, section 13.1.2: weak comparison).
bool namesEtag(std::string_view ifNoneMatch, std::string_view etag);

}  // namespace volcast::net
