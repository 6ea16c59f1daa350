#include "server/net/origin.h"

#include <algorithm>
#include <cctype>

namespace volcast::net {

namespace {

bool sameText(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Host and port without the scheme; empty for an origin that is not a web page's ("null").
std::string_view hostOf(std::string_view origin) {
    const auto scheme = origin.find("://");
    return scheme == std::string_view::npos ? std::string_view{} : origin.substr(scheme + 3);
}

std::string_view withoutPort(std::string_view host) {
    if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
    // A bare IPv6 address has several colons and no port.
    if (std::ranges::count(host, ':') > 1) return host;
    return host.substr(0, host.find(':'));
}

}  // namespace

bool isLoopbackName(std::string_view host) {
    const std::string_view name = withoutPort(host);
    // Digits and dots only: "127.example.org" is somebody's name.
    const bool numbers =
        std::ranges::all_of(name, [](unsigned char c) { return c == '.' || std::isdigit(c) != 0; });
    return sameText(name, "localhost") || name == "::1" || (numbers && name.starts_with("127."));
}

bool originAllowed(std::string_view origin, std::string_view host, const OriginRule& rule) {
    if (origin.empty()) return true;
    const bool listed = std::ranges::any_of(rule.allowed, [&](const std::string& allowed) {
        return allowed == "*" || sameText(allowed, origin);
    });
    if (listed) return true;
    if (rule.loopbackOnly && !isLoopbackName(host)) return false;
    const std::string_view page = hostOf(origin);
    return !page.empty() && sameText(page, host);
}

}  // namespace volcast::net
