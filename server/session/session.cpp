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
    for (const auto& [number, view] : views_) {
        shared_.router.remove(view->global);
        shared_.render.dropView(view->global);
    }
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
        case v1::ClientMessage::kExplain: return explain(message->explain());
        case v1::ClientMessage::kMeasureAccuracy:
            return measureAccuracy(message->measure_accuracy());
        case v1::ClientMessage::kPick: return pick(message->pick());
        case v1::ClientMessage::kDescribeShader: return describeShader(message->describe_shader());
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
    if (!message.codecs().empty()) {
        codecs_.jpeg = std::ranges::count(message.codecs(), v1::CODEC_JPEG) != 0;
        codecs_.png = std::ranges::count(message.codecs(), v1::CODEC_PNG) != 0;
    }
    if (!codecs_.jpeg && !codecs_.png) {
        send(errorMessage(v1::ERROR_CODE_UNSUPPORTED, "this server sends JPEG and PNG only", {},
                          "hello.codecs"));
        return end({kPolicyViolation, "no codec in common"});
    }
    greeted_ = true;
    spdlog::info(R"(event=hello connection={} client="{}" form={})", number_,
                 base::printable(message.client(), 80), form_ == Form::kJson ? "json" : "binary");
    welcome();
}

void Session::welcome() {
    v1::ServerMessage message;
    v1::Welcome& welcome = *message.mutable_welcome();
    welcome.set_major(protocol::kMajor);
    welcome.set_minor(protocol::kMinor);
    welcome.set_server(shared_.server);
    welcome.set_source_url(shared_.sourceUrl);
    for (const auto codec : {v1::CODEC_JPEG, v1::CODEC_PNG}) welcome.add_codecs(codec);
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (row.onMeshes) welcome.add_mesh_models(worker::toMessage(row.model));
        if (row.onVolumes) welcome.add_volume_models(worker::toMessage(row.model));
    }
    v1::Limits& limits = *welcome.mutable_limits();
    limits.set_max_views(shared_.limits.maxViews);
    limits.set_max_side(scene::kMaxPictureSide);
    limits.set_max_layers(scene::Scene::kMaxLayers);
    limits.set_max_control_points(data::TransferFunction::kMaxPoints);
    limits.set_max_message_bytes(shared_.limits.maxMessageBytes);
    send(message);
    v1::ServerMessage list;
    *list.mutable_dataset_list() = shared_.catalogue.list();
    send(list);
}

void Session::openDataset(const v1::OpenDataset& message) {
    const auto info = shared_.catalogue.open(message.dataset());
    if (!info) return send(errorMessage(info.error(), {.dataset = message.dataset()}));
    v1::ServerMessage reply;
    *reply.mutable_dataset_info() = *info;
    send(reply);
}

void Session::openView(const v1::OpenView& message, TimePoint now) {
    const ErrorContext about{
        .view = message.view(), .inputSeq = message.input_seq(), .dataset = message.dataset()};
    if (message.view() == 0) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT, "view numbers begin at 1", about,
                                 "view"));
    }
    if (find(message.view()) != nullptr) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                                 "view " + std::to_string(message.view()) + " is open already",
                                 about, "view"));
    }
    if (views_.size() >= shared_.limits.maxViews) {
        return send(errorMessage(v1::ERROR_CODE_LIMIT_EXCEEDED,
                                 "this connection has " + std::to_string(views_.size()) +
                                     " views, the most that it may have",
                                 about, "view"));
    }
    auto view = std::make_unique<View>(
        View{.number = message.view(),
             .scene = ViewScene{shared_.catalogue, shared_.limits.maxViewPixels},
             .frames = ViewFrames{codecs_},
             .inputAt = now});
    const auto change = view->scene.open(message);
    if (!change) return send(errorMessage(change.error(), about));
    const std::uint64_t global = view->global = shared_.router.reserve();
    shared_.router.add(
        global, {.rendered = onStrand([](Session& self, const workers::RenderedFrame& frame) {
                     self.rendered(frame);
                 }),
                 .failed = onStrand([global](Session& self, std::uint64_t tag, const Error& error) {
                     self.failed(global, tag, error);
                 }),
                 .measured = onStrand([global](Session& self, std::uint64_t tag,
                                               const Result<accuracy::Measurement>& result) {
                     self.measured(global, tag, result);
                 }),
                 .picked = onStrand([global](Session& self, std::uint64_t tag,
                                             const Result<std::optional<scene::Picked>>& result) {
                     self.picked(global, tag, result);
                 }),
                 .recovering = onStrand([global](Session& self) { self.recovering(global); })});
    const std::uint32_t number = message.view();
    spdlog::info("event=view_opened connection={} view={} global={}", number_, number,
                 view->global);
    View& added = *(views_[number] = std::move(view));
    added.frames.input(now);
    apply(added, *change);
}

void Session::updateView(const v1::Update& message, TimePoint now) {
    View* view = findOrRefuse(message.view(), message.input_seq());
    if (view == nullptr) return;
    const auto change = view->scene.update(message);
    if (!change) {
        return send(errorMessage(change.error(),
                                 {.view = message.view(), .inputSeq = message.input_seq()}));
    }
    if (*change == SceneChange::kNone) return;
    view->inputAt = now;
    view->frames.input(now);
    stopMeasuring(*view, "the view changed");
    apply(*view, *change);
}

void Session::closeView(std::uint32_t number) {
    const View* view = findOrRefuse(number, 0);
    if (view == nullptr) return;
    spdlog::info("event=view_closed connection={} view={} frames={}", number_, number,
                 view->frames.framesSent());
    shared_.router.remove(view->global);
    shared_.render.dropView(view->global);
    views_.erase(number);
}

void Session::ack(const v1::Ack& message, TimePoint now) {
    View* view = find(message.view());
    if (view == nullptr) return;  // Of a view that was just closed.
    view->frames.acked({.sequence = message.sequence(),
                        .hold = std::chrono::microseconds{message.hold_us()},
                        .queued = message.queue()},
                       now);
    shared_.metrics.frameAcked(
        std::chrono::duration<double, std::milli>{view->frames.flow().roundTrip()}.count());
    advance(*view, now);
}

std::optional<Outgoing> Session::next(TimePoint now) {
    if (!waiting_.empty()) {
        Outgoing out{.text = form_ == Form::kJson,
                     .head = bytesOf(writeMessage(waiting_.front(), form_)),
                     .payload = {}};
        waiting_.pop_front();
        return out;
    }
    if (closing_) return std::nullopt;
    // Views take turns, beginning behind the one served last.
    auto at = views_.upper_bound(lastServed_);
    for (std::size_t i = 0; i < views_.size(); ++i, ++at) {
        if (at == views_.end()) at = views_.begin();
        View& view = *at->second;
        auto frame = view.frames.takeFrame(now);
        if (!frame) continue;
        shared_.metrics.frameSent(frame->header, frame->payload.size(),
                                  view.frames.flow().underWay());
        lastServed_ = view.number;
        advance(view, now);
        return Outgoing{.text = false,
                        .head = protocol::encodeFrameHead(view.number, frame->sequence,
                                                          frame->header, form_ == Form::kJson),
                        .payload = std::move(frame->payload)};
    }
    return std::nullopt;
}

void Session::tick(TimePoint now) {
    if (!greeted_ && !closing_ && now - created_ > kHelloWithin) {
        send(errorMessage(v1::ERROR_CODE_TIMEOUT, "no hello within 30 s"));
        end({kPolicyViolation, "no hello"});
    }
    for (const auto& [number, view] : views_) {
        view->frames.tick(now);
        advance(*view, now);
    }
}

std::optional<TimePoint> Session::deadline(TimePoint now) const {
    std::optional<TimePoint> first;
    if (!greeted_) first = created_ + kHelloWithin;
    for (const auto& [number, view] : views_) {
        const auto one = view->frames.deadline(now);
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

Session::View* Session::find(std::uint32_t number) {
    const auto found = views_.find(number);
    return found == views_.end() ? nullptr : found->second.get();
}

Session::View* Session::findOrRefuse(std::uint32_t number, std::uint64_t inputSeq) {
    View* view = find(number);
    if (view == nullptr) {
        send(errorMessage(v1::ERROR_CODE_NOT_FOUND,
                          "view " + std::to_string(number) + " is not open",
                          {.view = number, .inputSeq = inputSeq}, "view"));
    }
    return view;
}

}  // namespace volcast::session
