#pragma once

#include <memory>
#include <string>

#include <boost/asio/ssl/context.hpp>

#include "renderer/base/result.h"

namespace volcast::net {

/// Takes TLS 1.2 and later with the certificate chain and private key of two PEM files.
///
/// Errors: kIo (a file cannot be read), kInvalidArgument (it is no PEM of its kind, the key is
/// encrypted, or it does not belong to the certificate).
Result<std::unique_ptr<boost::asio::ssl::context>> tlsContext(const std::string& certFile,
                                                              const std::string& keyFile);

}  // namespace volcast::net
