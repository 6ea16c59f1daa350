#include "server/session/session.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "protocol/framing.h"
#include "renderer/base/printable.h"
#include "renderer/scene/ray_models.h"
#include "renderer/worker/scene_message.h"
#include "server/session/on_strand.h"

namespace volcast::session {

namespace {

constexpr std::uint16_t kPolicyViolation = 1008;
constexpr std::uint16_t kInternalError = 1011;
constexpr std::uint16_t kGoesOnElsewhere = 4001;  ///< protocol/README.md.

std::vector<std::byte> bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::shared_ptr<Session> Session::create(Shared& shared, std::uint64_t number, SessionHooks hooks) {
    std::shared_ptr<Session> made{new Session{shared, number, std::move(hooks)}};
    made->start();
    return made;
}

Session::Session(Shared& shared, std::uint64_t number, SessionHooks hooks)
    : shared_{shared},
      number_{number},
      hooks_{std::move(hooks)},
      rate_{shared.limits.maxMessagesPerS} {}

void Session::start() {
    subscription_ = shared_.catalogue.subscribe(
        onStrand([](Session& self, const v1::DatasetInfo& info) { self.datasetChanged(info); }));
}

Session::~Session() {
    shared_.catalogue.unsubscribe(subscription_);
    if (!greeted_) return;
    const auto until = Clock::now() + shared_.views.keep();
    for (const auto& [number, seat] : seats_) {
        spdlog::info("event=view_lost connection={} view={} frames={}", number_, seat.view->id(),
                     seat.view->framesSent(seat.viewer));
        seat.view->lose(seat.viewer, until);
    }
    shared_.views.people().lost(who_.person, who_.visit, until);
}

void Session::receive(std::span<const std::byte> bytes, Form form, TimePoint now) {
    if (closing_) return;
    if (!greeted_) form_ = form;
    if (!rate_.take(now)) {
        send(errorMessage(
            v1::ERROR_CODE_LIMIT_EXCEEDED,
            "more than " + std::to_string(shared_.limits.maxMessagesPerS) + " messages a second"));
        return end({kPolicyViolation, "too many messages a second"});
    }
    const auto message = readMessage(bytes, form);
    if (!message) {
        send(errorMessage(v1::ERROR_CODE_MALFORMED_MESSAGE, message.error().message));
        if (!greeted_) end({kPolicyViolation, "malformed hello"});
        return;
    }
    if (greeted_ && !std::exchange(answered_, true)) {
        shared_.views.people().welcomed(who_.person, who_.visit);
    }
    if (message->has_hello()) return hello(message->hello());
    if (!greeted_) {
        send(errorMessage(v1::ERROR_CODE_UNEXPECTED_MESSAGE, "the first message must be hello"));
        return end({kPolicyViolation, "no hello"});
    }
    switch (message->body_case()) {
        case v1::ClientMessage::kOpenDataset: return openDataset(message->open_dataset());
        case v1::ClientMessage::kOpenView: return openView(message->open_view(), now);
        case v1::ClientMessage::kUpdate: return updateView(message->update(), now);
        case v1::ClientMessage::kCloseView: return closeView(message->close_view().view());
        case v1::ClientMessage::kAck: return ack(message->ack(), now);
        case v1::ClientMessage::kShareView: return shareView(message->share_view());
        case v1::ClientMessage::kTakeControl: return takeControl(message->take_control());
        case v1::ClientMessage::kHandOver: return handOver(message->hand_over());
        case v1::ClientMessage::kAskControl: return askControl(message->ask_control());
        case v1::ClientMessage::kSetName: return setName(message->set_name());
        case v1::ClientMessage::kUndo: return undo(message->undo(), now);
        case v1::ClientMessage::kExplain: return explain(message->explain());
        case v1::ClientMessage::kMeasureAccuracy:
            return measureAccuracy(message->measure_accuracy());
        case v1::ClientMessage::kMeasureDifference:
            return measureDifference(message->measure_difference());
        case v1::ClientMessage::kPick: return pick(message->pick());
        case v1::ClientMessage::kDescribeShader: return describeShader(message->describe_shader());
        case v1::ClientMessage::kInjectFault: return injectFault(message->inject_fault());
        case v1::ClientMessage::kSetPins: return setPins(message->set_pins(), now);
        case v1::ClientMessage::kPatchDecoded: return patchDecoded(message->patch_decoded());
        case v1::ClientMessage::kDrawThumbnail: return drawThumbnail(message->draw_thumbnail());
        case v1::ClientMessage::kDrawDatasetThumbnail:
            return drawDatasetThumbnail(message->draw_dataset_thumbnail());
        case v1::ClientMessage::kPing: {
            v1::ServerMessage reply;
            reply.mutable_pong()->set_token(message->ping().token());
            return send(reply);
        }
        default: break;
    }
    // A body of a later minor, or none at all.
    send(errorMessage(v1::ERROR_CODE_MALFORMED_MESSAGE,
                      "the message has no body that this server knows"));
}

void Session::hello(const v1::Hello& message) {
    if (greeted_) {
        return send(errorMessage(v1::ERROR_CODE_UNEXPECTED_MESSAGE, "hello came twice"));
    }
    if (message.major() != protocol::kMajor) {
        send(errorMessage(v1::ERROR_CODE_UNSUPPORTED_VERSION,
                          "protocol version " + std::to_string(message.major()) +
                              "; this server speaks " + std::to_string(protocol::kMajor),
                          {}, "hello.major"));
        return end({kPolicyViolation, "another protocol version"});
    }
    if (const auto taken = takeCodecs(message); !taken) {
        send(errorMessage(taken.error(), {}));
        return end({kPolicyViolation, "no codec in common"});
    }
    if (!identify(message)) return;
    takeAccess(message.access());
    greeted_ = true;
    spdlog::info(R"(event=hello connection={} client="{}" form={} person={} resumed={})", number_,
                 base::printable(message.client(), 80), form_ == Form::kJson ? "json" : "binary",
                 who_.person, resumed_);
    welcome();
    comeBack(who_.views);
}

bool Session::identify(const v1::Hello& message) {
    if (!checkName(message.person(), "hello.person")) {
        end({kPolicyViolation, "name too long"});
        return false;
    }
    PersonBook& people = shared_.views.people();
    const auto replaced = onStrand([](Session& self) {
        self.end({kGoesOnElsewhere, "another connection goes on"});
    });
    if (!message.resume().empty()) {
        const auto back = people.resume(message.resume(), replaced, Clock::now());
        resumed_ = back.has_value();
        if (resumed_) {
            who_ = *back;
            return true;
        }
        send(errorMessage(v1::ERROR_CODE_NOT_PERMITTED, back.error().message, {},
                          back.error().field));
    }
    const auto arrival = people.arrive(base::printable(message.person()), replaced);
    if (!arrival) {
        send(errorMessage(arrival.error(), {}));
        end({kInternalError, "no random bytes"});
        return false;
    }
    who_ = *arrival;
    return true;
}

void Session::takeAccess(const std::string& token) {
    mayChangeServer_ = shared_.uploads == nullptr || !shared_.uploads->limits().needToken;
    if (!mayChangeServer_ && !token.empty()) {
        const auto access = shared_.views.access(token);
        if (!access) {
            send(errorMessage(v1::ERROR_CODE_NOT_PERMITTED, access.error().message, {},
                              "hello.access"));
        }
        mayChangeServer_ = access && access->role == v1::ROLE_CONTROL;
    }
    mayUpload_ = shared_.uploads != nullptr && mayChangeServer_;
}

void Session::welcome() {
    v1::ServerMessage message;
    v1::Welcome& welcome = *message.mutable_welcome();
    welcome.set_major(protocol::kMajor);
    welcome.set_minor(protocol::kMinor);
    welcome.set_server(shared_.server);
    welcome.set_source_url(shared_.sourceUrl);
    for (const v1::Codec codec : codecsHere()) welcome.add_codecs(codec);
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (row.onMeshes) welcome.add_mesh_models(worker::toMessage(row.model));
        if (row.onVolumes) welcome.add_volume_models(worker::toMessage(row.model));
    }
    welcome.set_resume(who_.token);
    welcome.set_resumed(resumed_);
    welcome.set_person(who_.person);
    v1::Limits& limits = *welcome.mutable_limits();
    limits.set_max_people(static_cast<std::uint32_t>(shared_.views.maxPeople()));
    limits.set_max_views(shared_.limits.maxViews);
    limits.set_max_side(scene::kMaxPictureSide);
    limits.set_max_layers(scene::Scene::kMaxLayers);
    limits.set_max_control_points(data::TransferFunction::kMaxPoints);
    limits.set_max_message_bytes(shared_.limits.maxMessageBytes);
    if (mayUpload_) {
        welcome.mutable_uploads()->set_max_bytes(shared_.uploads->limits().maxBytes);
        welcome.mutable_uploads()->set_max_files(shared_.uploads->limits().maxFiles);
    }
    send(message);
    v1::ServerMessage list;
    *list.mutable_dataset_list() = shared_.catalogue.list();
    send(list);
}

std::optional<Outgoing> Session::next(TimePoint now) {
    if (!waiting_.empty()) {
        Outgoing out{.text = form_ == Form::kJson,
                     .head = bytesOf(writeMessage(waiting_.front(), form_))};
        waiting_.pop_front();
        return out;
    }
    if (closing_) return std::nullopt;
    if (auto patch = nextPatch()) return patch;
    for (const auto& [number, seat] : seats_) {
        const auto mail = seat.view->takeMail(seat.viewer);
        if (!mail) continue;
        return Outgoing{.text = form_ == Form::kJson, .head = bytesOf(writeMessage(*mail, form_))};
    }
    // Views take turns, beginning behind the one served last.
    auto at = seats_.upper_bound(lastServed_);
    for (std::size_t i = 0; i < seats_.size(); ++i, ++at) {
        if (at == seats_.end()) at = seats_.begin();
        auto frame = at->second.view->takeFrame(at->second.viewer, now);
        if (!frame) continue;
        shared_.metrics.frameSent(frame->header, frame->payload->size(),
                                  frame->header.pace().under_way());
        lastServed_ = at->first;
        return Outgoing{.text = false,
                        .head = protocol::encodeFrameHead(at->first, frame->sequence, frame->header,
                                                          form_ == Form::kJson),
                        .payload = std::move(frame->payload)};
    }
    return std::nullopt;
}

void Session::tick(TimePoint now) {
    if (!greeted_ && !closing_ && now - created_ > kHelloWithin) {
        send(errorMessage(v1::ERROR_CODE_TIMEOUT, "no hello within 30 s"));
        end({kPolicyViolation, "no hello"});
    }
    for (const auto& [number, seat] : seats_) seat.view->tick(seat.viewer, now);
}

std::optional<TimePoint> Session::deadline(TimePoint now) const {
    std::optional<TimePoint> first;
    if (!greeted_) first = created_ + kHelloWithin;
    for (const auto& [number, seat] : seats_) {
        const auto one = seat.view->deadline(seat.viewer, now);
        if (one && (!first || *one < *first)) first = one;
    }
    return first;
}

void Session::end(Closing closing) {
    if (!closing_) closing_ = std::move(closing);
}

void Session::send(const v1::ServerMessage& message) {
    if (closing_) return;
    if (waiting_.size() >= shared_.limits.maxWaitingMessages) {
        spdlog::warn("event=client_does_not_read connection={} waiting={}", number_,
                     waiting_.size());
        return end({kPolicyViolation, "replies are not being read"});
    }
    if (message.has_error()) shared_.metrics.refused(message.error().code());
    waiting_.push_back(message);
}

}  // namespace volcast::session
