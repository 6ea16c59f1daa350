#include "server/net/tls.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509err.h>

namespace volcast::net {

namespace {

namespace ssl = boost::asio::ssl;
using SystemError = boost::system::error_code;

Result<void> readable(const char* flag, const std::string& file) {
    errno = 0;
    std::ifstream stream{file};
    if (stream.get() != std::ifstream::traits_type::eof()) return {};
    const char* why = errno != 0 ? std::strerror(errno) : "is empty";
    return fail(ErrorCode::kIo, std::string{flag} + " " + file + ": " + why);
}

Error badFile(const char* flag, const std::string& file, const char* kind,
              const SystemError& error) {
    return fail(ErrorCode::kInvalidArgument, std::string{flag} + " " + file +
                                                 ": not a PEM file of " + kind + " (" +
                                                 error.message() + ")");
}

}  // namespace

Result<std::unique_ptr<ssl::context>> tlsContext(const std::string& certFile,
                                                 const std::string& keyFile) {
    if (certFile.empty() || keyFile.empty()) {
        return fail(ErrorCode::kInvalidArgument, "--tls-cert and --tls-key belong together");
    }
    if (auto found = readable("--tls-cert", certFile); !found) return found.error();
    if (auto found = readable("--tls-key", keyFile); !found) return found.error();
    auto context = std::make_unique<ssl::context>(ssl::context::tls_server);
    ::SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
    ::SSL_CTX_set_options(context->native_handle(),
                          SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION);
    SystemError error;
    // Without it, OpenSSL asks for the password of an encrypted key on the terminal.
    context->set_password_callback(
        [](std::size_t, ssl::context::password_purpose) { return std::string{}; }, error);
    context->use_certificate_chain_file(certFile, error);
    if (error) return badFile("--tls-cert", certFile, "certificates", error);
    context->use_private_key_file(keyFile, ssl::context::pem, error);
    const auto code = static_cast<unsigned long>(error.value());
    if (error && ERR_GET_LIB(code) == ERR_LIB_X509 &&
        ERR_GET_REASON(code) == X509_R_KEY_VALUES_MISMATCH) {
        return fail(ErrorCode::kInvalidArgument,
                    "--tls-key " + keyFile + ": is not the key of the certificate in " + certFile);
    }
    if (error) return badFile("--tls-key", keyFile, "a private key without password", error);
    return context;
}

}  // namespace volcast::net
