#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/beast.h"
#include "server/net/origin.h"
#include "server/session/shared.h"
#include "server/session/upload_folder.h"

namespace volcast::net {

/// What a request below /v1/uploads/ is about.
struct UploadTarget {
    std::string token;  ///< Of the upload.
    std::string file;   ///< Empty: the upload as a whole.
    std::string name;   ///< "?name=": what a finished upload is to be called.
};

/// Errors: kInvalidArgument (not such a path).
Result<UploadTarget> uploadTargetOf(std::string_view target);

/// Answers requests for uploads; the bodies of files are read by upload_body.h.
///
/// PUT /v1/uploads/TOKEN/FILE takes a file, POST /v1/uploads/TOKEN?name=NAME makes a dataset of all
/// files so far, DELETE /v1/uploads/TOKEN removes them. protocol/README.md has the statuses.
class UploadAnswers {
public:
    UploadAnswers(session::Shared& shared, const OriginRule& origins)
        : shared_{shared}, origins_{origins} {}

    /// True for requests of this class.
    static bool concerns(const Request& request);
    /// True where a body follows that goes into a file, if the request has no refusal().
    static bool isFile(const Request& request) { return request.method() == http::verb::put; }
    /// None where uploads are on and the request may come from where it comes.
    [[nodiscard]] std::optional<Response> refusal(const Request& request) const;
    /// Of what has no body.
    [[nodiscard]] Response answer(const Request& request) const;
    [[nodiscard]] static Response refused(const Request& request,
                                          const session::UploadError& error);
    /// `late`: the client was too slow; else it ended the connection or sent no proper body.
    [[nodiscard]] static Response cutShort(const Request& request, bool late, std::uint64_t bytes,
                                           const session::UploadLimits& limits);
    [[nodiscard]] static Response received(const Request& request, std::uint64_t bytes);
    [[nodiscard]] session::UploadFolder& folder() const { return *shared_.uploads; }

private:
    /// None where the request brings what it needs; else 401 or 403.
    [[nodiscard]] std::optional<Response> noRight(const Request& request) const;
    [[nodiscard]] Response finish(const Request& request, const UploadTarget& target) const;

    session::Shared& shared_;
    const OriginRule& origins_;
};

}  // namespace volcast::net
