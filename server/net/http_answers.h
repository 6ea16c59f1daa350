#pragma once

#include "server/net/beast.h"
#include "server/net/origin.h"
#include "server/net/static_files.h"
#include "server/session/shared.h"

namespace volcast::net {

/// Answers everything that is no WebSocket: files, /healthz, /readyz, refusals.
class HttpAnswers {
public:
    HttpAnswers(const StaticFiles& files, const session::Shared& shared)
        : files_{files}, shared_{shared} {}

    [[nodiscard]] Response answer(const Request& request) const;
    /// A clear text with security headers.
    [[nodiscard]] static Response plain(const Request& request, http::status status,
                                        std::string text);

private:
    [[nodiscard]] Response file(const Request& request) const;

    const StaticFiles& files_;
    const session::Shared& shared_;
};

}  // namespace volcast::net
