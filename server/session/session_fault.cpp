// What a session lets fail, where its server allows that.
#include <spdlog/spdlog.h>

#include "server/session/session.h"

namespace volcast::session {

std::optional<Error> Session::whyNotInjecting(const Seat& seat) const {
    if (!mayChangeServer_) {
        return fail(ErrorCode::kInvalidArgument,
                    "this server asks for tokens (--uploads-need-token): faults need an access "
                    "token of ROLE_CONTROL in the hello",
                    "hello.access");
    }
    // Who may share a view is who may steer it.
    if (!seat.view->whyNotSharing(seat.viewer).empty()) {
        return fail(ErrorCode::kInvalidArgument,
                    "you have ROLE_WATCH in this view; faults need ROLE_CONTROL", "view");
    }
    return std::nullopt;
}

void Session::injectFault(const v1::InjectFault& message) {
    const ErrorContext about{.view = message.view()};
    if (shared_.faults == nullptr) {
        return send(errorMessage(v1::ERROR_CODE_NOT_PERMITTED,
                                 "this server was not started with --allow-faults", about));
    }
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    if (const auto refused = whyNotInjecting(*seat)) {
        return send(
            errorMessage(v1::ERROR_CODE_NOT_PERMITTED, refused->message, about, refused->field));
    }
    const auto fault = worker::parseFault(message.fault());
    if (!fault) {
        return send(
            errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT, fault.error().message, about, "fault"));
    }
    spdlog::warn("event=fault connection={} view={} fault={}", number_, seat->view->id(),
                 worker::toText(*fault));
    shared_.faults->inject(seat->view->global(), *fault);
}

}  // namespace volcast::session
