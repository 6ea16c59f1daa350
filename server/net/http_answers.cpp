#include "server/net/http_answers.h"

#include <string>
#include <utility>

#include "server/net/negotiation.h"
#include "server/session/metrics_text.h"
#include "server/session/readiness.h"

namespace volcast::net {

namespace {

/// Everything from here, nothing inline but what the page draws itself (blob: decoded pictures).
constexpr const char* kContentSecurity =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "font-src 'self'; connect-src 'self'; worker-src 'self' blob:; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

constexpr const char* kNotBuilt =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Volcast</title>"
    "<h1>The server runs; its web client is not built yet</h1>"
    "<p>Build it with <code>npm ci &amp;&amp; npm run build</code> in <code>web_client</code>, or "
    "start the server by <code>deploy/run</code>, which does that. Scripts can connect to "
    "<code>/v1/ws</code> now.</p>";

Response make(const Request& request, http::status status, std::string body,
              const std::string& type) {
    Response response{status, request.version()};
    response.set(http::field::server, "volcast");
    response.set(http::field::content_type, type);
    response.set("Content-Security-Policy", kContentSecurity);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set(http::field::cache_control, "no-store");
    response.keep_alive(request.keep_alive());
    response.body() = std::move(body);
    response.prepare_payload();
    return response;
}

/// HEAD: the same headers, length included, and no body.
Response withoutBody(Response response) {
    const std::size_t length = response.body().size();
    response.body().clear();
    response.content_length(length);
    return response;
}

}  // namespace

Response HttpAnswers::plain(const Request& request, http::status status, std::string text) {
    return make(request, status, std::move(text) + "\n", "text/plain; charset=utf-8");
}

Response HttpAnswers::answer(const Request& request, bool fromLoopback) const {
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
        Response refusal =
            plain(request, http::status::method_not_allowed,
                  std::string{request.method_string()} + " is not offered; GET and HEAD are");
        refusal.set(http::field::allow, "GET, HEAD");
        refusal.keep_alive(false);  // Its body was not read.
        return refusal;
    }
    const std::string_view target = request.target();
    const std::string_view path = target.substr(0, target.find('?'));
    Response response;
    if (path == "/healthz") {
        response = plain(request, http::status::ok, "ok");
    } else if (path == "/readyz") {
        const workers::RenderStatus status = shared_.render.status();
        response =
            make(request, status.ready ? http::status::ok : http::status::service_unavailable,
                 session::readinessJson(status), "application/json");
    } else if (path == "/metrics") {
        response = metrics(request, fromLoopback);
    } else if (path == "/v1/ws") {
        response = plain(request, http::status::upgrade_required,
                         "this is the WebSocket; connect with subprotocol volcast.v1");
        response.set(http::field::upgrade, "websocket");
    } else {
        response = file(request);
    }
    return request.method() == http::verb::head ? withoutBody(std::move(response)) : response;
}

/// What a proxy on this machine passes on comes from the loopback, too, but says so.
Response HttpAnswers::metrics(const Request& request, bool fromLoopback) const {
    if (metricsFor_ == MetricsFor::kNobody) {
        return plain(request, http::status::not_found, "there are no metrics (--metrics off)");
    }
    const bool passedOn = request.find("X-Forwarded-For") != request.end() ||
                          request.find(http::field::forwarded) != request.end();
    if (metricsFor_ == MetricsFor::kThisMachine && (!fromLoopback || passedOn)) {
        return plain(request, http::status::forbidden,
                     "metrics are for this machine only (--metrics all: for everybody)");
    }
    return make(request, http::status::ok, session::metricsText(shared_),
                "text/plain; version=0.0.4; charset=utf-8");
}

Response HttpAnswers::file(const Request& request) const {
    const std::string_view target = request.target();
    auto found = files_.read(target, acceptsGzip(request[http::field::accept_encoding]));
    if (!found) {
        if (target == "/" && !files_.built()) {
            return make(request, http::status::service_unavailable, kNotBuilt,
                        "text/html; charset=utf-8");
        }
        switch (found.error().code) {
            case ErrorCode::kInvalidArgument:
                return plain(request, http::status::bad_request, found.error().message);
            case ErrorCode::kNotFound:
                return plain(request, http::status::not_found, "there is no such file");
            default:
                return plain(request, http::status::internal_server_error,
                             "the file cannot be read");
        }
    }
    const bool same = namesEtag(request[http::field::if_none_match], found->etag);
    Response response = make(request, same ? http::status::not_modified : http::status::ok,
                             same ? std::string{} : std::move(found->content), found->mimeType);
    response.set(http::field::etag, found->etag);
    response.set(http::field::cache_control, found->cacheControl);
    if (found->varies) response.set(http::field::vary, "Accept-Encoding");
    if (found->gzipped && !same) response.set(http::field::content_encoding, "gzip");
    return response;
}

}  // namespace volcast::net
