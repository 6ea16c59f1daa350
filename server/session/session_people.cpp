// What a client asks of people: links, who steers, coming back.
#include <chrono>
#include <utility>

#include "renderer/base/printable.h"
#include "server/session/session.h"

namespace volcast::session {

namespace {

constexpr std::chrono::seconds kUsualLife = std::chrono::hours{24};
constexpr std::size_t kMostNameBytes = 64;
constexpr std::chrono::seconds kLongestLife = std::chrono::hours{24} * 30;

}  // namespace

void Session::joinView(const v1::OpenView& message, scene::PictureSize size, TimePoint now) {
    const std::uint32_t number = message.view();
    const ErrorContext about{.view = number, .inputSeq = message.input_seq()};
    if (message.has_scene() || !message.dataset().empty()) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                                 "a link joins a view as it is; scene and dataset must be absent",
                                 about, message.has_scene() ? "scene" : "dataset"));
    }
    const auto link = shared_.views.link(message.link());
    if (!link) {
        return send(
            errorMessage(v1::ERROR_CODE_NOT_PERMITTED, link.error().message, about, "link"));
    }
    auto view = shared_.views.find(link->view);
    if (!view) {
        return send(errorMessage(v1::ERROR_CODE_NOT_FOUND, "the view of this link has ended", about,
                                 "link"));
    }
    const auto viewer =
        view->join(viewerDesc(number, size),
                   {.person = who_.person, .name = who_.name, .role = link->role}, now);
    if (!viewer) return send(errorMessage(viewer.error(), about));
    takeSeat(number, std::move(view), *viewer);
}

void Session::comeBack(const std::map<std::uint32_t, std::string>& views) {
    for (const auto& [number, id] : views) {
        auto view = shared_.views.find(id);
        const auto viewer =
            view ? view->comeBack(viewerDesc(number, {}), who_.person, Clock::now()) : std::nullopt;
        if (viewer) {
            takeSeat(number, std::move(view), *viewer);
            continue;
        }
        shared_.views.people().closed(who_.person, number);
        const std::string why =
            view ? "your place in view " + std::to_string(number) +
                       " went to somebody else: the view was full (--max-people) and you were away"
                 : "view " + std::to_string(number) + " has ended meanwhile";
        send(errorMessage(v1::ERROR_CODE_NOT_FOUND, why, {.view = number}));
    }
}

void Session::shareView(const v1::ShareView& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const ErrorContext about{.view = message.view()};
    if (message.role() != v1::ROLE_WATCH && message.role() != v1::ROLE_CONTROL) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                                 "a link gives ROLE_WATCH or ROLE_CONTROL", about, "role"));
    }
    const auto life =
        message.expires_s() == 0 ? kUsualLife : std::chrono::seconds{message.expires_s()};
    if (life > kLongestLife) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                                 "a link for " + std::to_string(life.count()) +
                                     " s; the limit is " + std::to_string(kLongestLife.count()),
                                 about, "expires_s"));
    }
    if (const std::string why = seat->view->whyNotSharing(seat->viewer); !why.empty()) {
        return send(errorMessage(v1::ERROR_CODE_NOT_PERMITTED, why, about, "view"));
    }
    const auto expires =
        std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()) + life;
    const auto link = shared_.views.share(*seat->view, message.role(), expires);
    if (!link) return send(errorMessage(link.error(), about));
    v1::ServerMessage reply;
    v1::ViewShared& shared = *reply.mutable_view_shared();
    shared.set_view(message.view());
    shared.set_link(*link);
    shared.set_url("/#link=" + *link);  // Behind the # it is not sent to servers, nor logged there.
    shared.set_role(message.role());
    shared.set_expires(static_cast<std::uint64_t>(expires.time_since_epoch().count()));
    send(reply);
}

void Session::takeControl(const v1::TakeControl& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat != nullptr) seat->view->takeControl(seat->viewer);
}

void Session::handOver(const v1::HandOver& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat != nullptr) seat->view->handOver(seat->viewer, message.person());
}

void Session::askControl(const v1::AskControl& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat != nullptr) seat->view->askControl(seat->viewer, message.withdraw());
}

bool Session::checkName(const std::string& name, const char* field) {
    if (name.size() <= kMostNameBytes) return true;
    send(errorMessage(v1::ERROR_CODE_LIMIT_EXCEEDED,
                      "a name of " + std::to_string(name.size()) + " bytes; the limit is " +
                          std::to_string(kMostNameBytes),
                      {}, field));
    return false;
}

void Session::setName(const v1::SetName& message) {
    if (!checkName(message.person(), "person")) return;
    who_.name = shared_.views.people().rename(who_.person, base::printable(message.person()));
    for (const auto& [number, seat] : seats_) seat.view->rename(seat.viewer, who_.name);
}

void Session::undo(const v1::Undo& message, TimePoint now) {
    const Seat* seat = findOrRefuse(message.view(), message.input_seq());
    if (seat != nullptr) seat->view->undo(seat->viewer, message, now);
}

}  // namespace volcast::session
