#include "server/net/uploads.h"

#include <boost/json.hpp>
#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/net/http_answers.h"
#include "server/net/static_files.h"
#include "server/session/views.h"

namespace volcast::net {

namespace {

using session::UploadRefusal;

/// Of "Authorization: Bearer TOKEN" (RFC 6750, section 2.1); empty where there is none.
std::string bearerOf(const Request& request) {
    constexpr std::string_view kScheme = "bearer ";
    const std::string_view value = request[http::field::authorization];
    if (!beast::iequals(value.substr(0, kScheme.size()), kScheme)) return {};
    return std::string{value.substr(kScheme.size())};
}

constexpr std::string_view kPath = "/v1/uploads/";

http::status statusOf(UploadRefusal why) {
    switch (why) {
        case UploadRefusal::kBadName: return http::status::bad_request;
        case UploadRefusal::kTooLarge: return http::status::payload_too_large;
        case UploadRefusal::kNoRoom: return http::status::insufficient_storage;
        case UploadRefusal::kBusy: return http::status::service_unavailable;
        case UploadRefusal::kConflict: return http::status::conflict;
        case UploadRefusal::kNotFound: return http::status::not_found;
        case UploadRefusal::kNothingToRead: return http::status::unprocessable_entity;
        case UploadRefusal::kIo: break;
    }
    return http::status::internal_server_error;
}

Response json(const Request& request, http::status status, const boost::json::value& value) {
    Response response = HttpAnswers::plain(request, status, boost::json::serialize(value));
    response.set(http::field::content_type, "application/json");
    return response;
}

}  // namespace

Result<UploadTarget> uploadTargetOf(std::string_view target) {
    const auto refuse = [] {
        return fail(ErrorCode::kInvalidArgument,
                    "uploads are at /v1/uploads/TOKEN/FILE and /v1/uploads/TOKEN?name=NAME");
    };
    auto path = pathOf(target);
    if (!path || !('/' + *path).starts_with(kPath)) return refuse();
    UploadTarget found;
    found.token = path->substr(kPath.size() - 1);
    if (const auto slash = found.token.find('/'); slash != std::string::npos) {
        found.file = found.token.substr(slash + 1);
        found.token.resize(slash);
        if (found.file.empty()) return refuse();
    }
    constexpr std::string_view kName = "?name=";
    const auto query = target.find('?');
    if (query == std::string_view::npos) return found;
    if (!target.substr(query).starts_with(kName)) return refuse();
    auto name = pathOf('/' + std::string{target.substr(query + kName.size())});
    if (!name) return refuse();
    found.name = std::move(*name);
    return found;
}

bool UploadAnswers::concerns(const Request& request) {
    return std::string_view{request.target()}.starts_with(kPath);
}

std::optional<Response> UploadAnswers::refusal(const Request& request) const {
    if (shared_.uploads == nullptr) {
        return HttpAnswers::plain(request, http::status::forbidden,
                                  "this server takes no uploads (--allow-uploads)");
    }
    const std::string_view origin = request[http::field::origin];
    if (!originAllowed(origin, request[http::field::host], origins_)) {
        spdlog::warn(R"(event=upload_origin_refused origin="{}")", base::printable(origin));
        return HttpAnswers::plain(request, http::status::forbidden,
                                  "pages of this origin may not upload; the server's "
                                  "--allow-origin lists those that may");
    }
    if (auto refused = noRight(request)) return refused;
    const auto target = uploadTargetOf(request.target());
    if (!target) {
        return HttpAnswers::plain(request, http::status::bad_request, target.error().message);
    }
    const http::verb method = request.method();
    const bool offered = target->file.empty()
                             ? method == http::verb::post || method == http::verb::delete_
                             : method == http::verb::put;
    if (offered) return std::nullopt;
    const char* methods = target->file.empty() ? "POST, DELETE" : "PUT";
    Response response = HttpAnswers::plain(
        request, http::status::method_not_allowed,
        std::string{request.method_string()} + " is not offered here; " + methods + " is");
    response.set(http::field::allow, methods);
    return response;
}

std::optional<Response> UploadAnswers::noRight(const Request& request) const {
    if (!folder().limits().needToken) return std::nullopt;
    const std::string token = bearerOf(request);
    const auto refuse = [&](http::status status, const std::string& why) {
        spdlog::warn(R"(event=upload_not_permitted error="{}")", why);
        Response response = HttpAnswers::plain(request, status, why);
        if (status == http::status::unauthorized) {
            response.set(http::field::www_authenticate, "Bearer");
        }
        return response;
    };
    if (token.empty()) {
        return refuse(http::status::unauthorized,
                      "uploads to this server need an access token (Authorization: Bearer TOKEN)");
    }
    const auto access = shared_.views.access(token);
    if (!access) return refuse(http::status::unauthorized, access.error().message);
    if (access->role == v1::ROLE_CONTROL) return std::nullopt;
    return refuse(http::status::forbidden,
                  "the access token allows to watch; uploads need one to control");
}

Response UploadAnswers::answer(const Request& request) const {
    const auto target = uploadTargetOf(request.target());
    if (!target) {
        return HttpAnswers::plain(request, http::status::bad_request, target.error().message);
    }
    if (request.method() == http::verb::post) return finish(request, *target);
    const auto cancelled = folder().cancel(target->token);
    if (!cancelled) return refused(request, cancelled.error());
    spdlog::info("event=upload_cancelled upload={}", base::printable(target->token));
    return json(request, http::status::ok, boost::json::object{});
}

Response UploadAnswers::finish(const Request& request, const UploadTarget& target) const {
    const auto ids = folder().finish(target.token, target.name);
    if (!ids) return refused(request, ids.error());
    spdlog::info(R"(event=uploaded upload={} name="{}" datasets={})", base::printable(target.token),
                 base::printable(target.name), ids->size());
    shared_.catalogue.refresh();
    return json(request, http::status::created, {{"datasets", boost::json::value_from(*ids)}});
}

Response UploadAnswers::refused(const Request& request, const session::UploadError& error) {
    spdlog::warn(R"(event=upload_refused error="{}")", base::printable(error.message, 1000));
    return HttpAnswers::plain(request, statusOf(error.why), error.message);
}

Response UploadAnswers::cutShort(const Request& request, bool late, std::uint64_t bytes,
                                 const session::UploadLimits& limits) {
    const std::string after = " after " + std::to_string(bytes) + " bytes";
    spdlog::warn("event=upload_cut_short late={} bytes={}", late, bytes);
    if (!late) {
        return HttpAnswers::plain(request, http::status::bad_request,
                                  "the file ended" + after + ", before all of it was there");
    }
    return HttpAnswers::plain(request, http::status::request_timeout,
                              "too slow" + after + ": 64 KiB may take " +
                                  std::to_string(limits.patience.count()) +
                                  " s (--upload-patience-s)");
}

Response UploadAnswers::received(const Request& request, std::uint64_t bytes) {
    return json(request, http::status::created, {{"bytes", bytes}});
}

}  // namespace volcast::net
