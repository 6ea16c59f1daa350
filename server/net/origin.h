#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace volcast::net {

/// Which web pages may open a WebSocket.
struct OriginRule {
    std::vector<std::string> allowed;  ///< Such as "https://lab.example.org"; "*": any.
    bool loopbackOnly = true;          ///< The server listens on a loopback address.
};

/// True for clients that are no web pages (no `origin`), pages of this very server (`origin` and
/// `host`, the request's headers, agree), and allowed origins.
///
/// On a loopback address `host` must also name a loopback: otherwise a hostile name that resolves
/// to 127.0.0.1 would count as the same origin (DNS rebinding).
bool originAllowed(std::string_view origin, std::string_view host, const OriginRule& rule);

/// True for "127.0.0.1", "::1", "localhost" and the like, with or without a port.
bool isLoopbackName(std::string_view host);

}  // namespace volcast::net
