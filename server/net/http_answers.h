#pragma once

#include "server/net/beast.h"
#include "server/net/origin.h"
#include "server/net/server.h"
#include "server/net/static_files.h"
#include "server/session/shared.h"

namespace volcast::net {

/// Answers everything that is no WebSocket: files, /healthz, /readyz, refusals.
class HttpAnswers {
public:
    HttpAnswers(const StaticFiles& files, session::Shared& shared, MetricsFor metricsFor)
        : files_{files}, shared_{shared}, metricsFor_{metricsFor} {}

    /// `fromLoopback`: the connection comes from this machine.
    [[nodiscard]] Response answer(const Request& request, bool fromLoopback) const;
    /// A clear text with security headers.
    [[nodiscard]] static Response plain(const Request& request, http::status status,
                                        std::string text);

private:
    [[nodiscard]] Response file(const Request& request) const;
    [[nodiscard]] Response metrics(const Request& request, bool fromLoopback) const;

    const StaticFiles& files_;
    session::Shared& shared_;
    MetricsFor metricsFor_;
};

}  // namespace volcast::net
