#include <charconv>

#include "renderer/base/printable.h"
#include "server/net/client_loop.h"

namespace volcast::net {

Result<WsUrl> parseWsUrl(const std::string& text) {
    const auto refuse = [&text](const char* why) {
        return fail(ErrorCode::kInvalidArgument, "\"" + base::printable(text) + "\": " + why);
    };
    const auto mark = text.find("://");
    const std::string scheme = text.substr(0, mark);
    WsUrl url{.tls = scheme == "wss" || scheme == "https", .host = {}};
    if (mark == std::string::npos || (!url.tls && scheme != "ws" && scheme != "http")) {
        return refuse("is not ws://HOST[:PORT], wss, http or https");
    }
    std::string place = text.substr(mark + 3);
    if (const auto slash = place.find('/'); slash != std::string::npos) {
        if (slash + 1 < place.size()) url.target = place.substr(slash);
        place.resize(slash);
    }
    url.port = url.tls ? 443 : 80;
    const auto colon = place.rfind(':');
    const bool hasPort = colon != std::string::npos && place.find(']', colon) == std::string::npos;
    if (hasPort) {
        const char* end = place.data() + place.size();
        const auto read = std::from_chars(place.data() + colon + 1, end, url.port);
        if (read.ec != std::errc{} || read.ptr != end || url.port == 0) {
            return refuse("its port is not a number from 1 to 65535");
        }
        place.resize(colon);
    }
    if (place.starts_with('[') && place.ends_with(']')) place = place.substr(1, place.size() - 2);
    if (place.empty()) return refuse("names no host");
    url.host = place;
    return url;
}

}  // namespace volcast::net
