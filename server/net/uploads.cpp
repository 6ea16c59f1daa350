#include "server/net/uploads.h"

#include <boost/json.hpp>
#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/net/http_answers.h"
#include "server/net/static_files.h"

namespace volcast::net {

namespace {

using session::UploadRefusal;

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
