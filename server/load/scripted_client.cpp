#include "server/load/scripted_client.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "protocol/framing.h"

namespace volcast::load {

namespace {

constexpr std::uint32_t kView = 1;
constexpr std::chrono::milliseconds kStay{500};  ///< Of "join", after its first frame.
constexpr std::chrono::milliseconds kAway{100};
constexpr std::chrono::milliseconds kRetry{1000};
constexpr std::chrono::milliseconds kBlindAck{20};

double msSince(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - then)
        .count();
}

}  // namespace

net::LinkShape ScriptedClient::shape() const {
    if (kind_ == Kind::kShaped) return stage_.settings.shaped;
    if (kind_ == Kind::kSlow) return {.bytesPerSecond = stage_.settings.slowBytesPerSecond};
    return {};
}

void ScriptedClient::start() {
    ++connection_;
    greeted_ = false;
    startedAt_ = newAt_ = Clock::now();
    shownSeq_ = 0;
    script_.reset();
    socket_ = stage_.loop.connect(
        stage_.settings.url, shape(),
        {.opened =
             [this] {
                 ++stats_.connects;
                 v1::ClientMessage message;
                 message.mutable_hello()->set_major(protocol::kMajor);
                 message.mutable_hello()->set_minor(protocol::kMinor);
                 message.mutable_hello()->set_client("volcast load");
                 message.mutable_hello()->add_codecs(v1::CODEC_JPEG);
                 message.mutable_hello()->add_codecs(v1::CODEC_PNG);
                 send(message);
             },
         .message = [this](std::span<const std::byte> bytes) { receive(bytes); },
         .closed = [this](const std::string& why) { closed(why); }});
}

void ScriptedClient::receive(std::span<const std::byte> bytes) {
    if (!bytes.empty() && bytes.front() == std::byte{protocol::kMajor}) return frame(bytes);
    v1::ServerMessage message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        ++stats_.errors["unreadable message of the server"];
        return;
    }
    switch (message.body_case()) {
        case v1::ServerMessage::kWelcome: return welcome(message.welcome());
        case v1::ServerMessage::kDatasetList:
            for (const auto& one : message.dataset_list().datasets()) {
                datasets_[one.id()] = one.kind();
            }
            return;
        case v1::ServerMessage::kDatasetInfo:
            datasets_[message.dataset_info().id()] = message.dataset_info().kind();
            return;
        case v1::ServerMessage::kViewOpened: return opened(message.view_opened());
        case v1::ServerMessage::kViewShared: return view_.shared(message.view_shared().link());
        case v1::ServerMessage::kError: return refused(message.error());
        default: return;
    }
}

void ScriptedClient::welcome(const v1::Welcome& message) {
    greeted_ = true;
    welcome_ = message;
    if (opens_ || !view_.link.empty()) return openView();
    view_.waiting.emplace_back([this, mine = connection_] {
        if (greeted_ && mine == connection_) openView();
    });
}

void ScriptedClient::openView() {
    v1::ClientMessage message;
    v1::OpenView& open = *message.mutable_open_view();
    open.set_view(kView);
    if (opens_) {
        open.set_dataset(stage_.settings.dataset);
    } else {
        open.set_link(view_.link);
    }
    open.mutable_viewport()->set_width(stage_.settings.width);
    open.mutable_viewport()->set_height(stage_.settings.height);
    open.set_input_seq(inputSeq_ = 1);
    send(message);
}

void ScriptedClient::opened(const v1::ViewOpened& message) {
    inputSeq_ = std::max(inputSeq_, message.input_seq());
    if (stage_.settings.acks != Acks::kFull || stage_.settings.quality) pin();
    if (stage_.settings.acks == Acks::kNone) ackBlindly(connection_);
    if (opens_ && view_.members > 1) {
        sharing_ = true;
        v1::ClientMessage share;
        share.mutable_share_view()->set_view(kView);
        share.mutable_share_view()->set_role(v1::ROLE_WATCH);
        send(share);
    }
    if (!opens_ || !moves(kind_)) return;
    const auto& layers = message.scene().layers();
    const bool isMesh = !layers.empty() && datasets_[layers[0].dataset()] == v1::DATASET_KIND_MESH;
    std::vector<v1::RayModel> models;
    for (const int model : isMesh ? welcome_.mesh_models() : welcome_.volume_models()) {
        models.push_back(static_cast<v1::RayModel>(model));
    }
    script_.emplace(kind_, message.scene(), std::move(models));
    input(connection_);
}

void ScriptedClient::input(std::uint64_t connection) {
    if (connection != connection_ || !greeted_ || !script_) return;
    v1::ClientMessage message;
    message.mutable_update()->set_view(kView);
    message.mutable_update()->set_input_seq(++inputSeq_);
    script_->next(*message.mutable_update());
    unanswered_.push_back({inputSeq_, Clock::now()});
    view_.sent(inputSeq_);
    if (stage_.measuring) ++stats_.inputs;
    send(message);
    const std::chrono::duration<double> period{1.0 / stage_.settings.inputsPerSecond};
    stage_.loop.at(Clock::now() + std::chrono::duration_cast<Clock::duration>(period),
                   [this, connection] { input(connection); });
}

void ScriptedClient::frame(std::span<const std::byte> bytes) {
    const auto frame = protocol::decodeFrame(bytes);
    if (!frame) {
        ++stats_.errors["unreadable frame"];
        return;
    }
    if (stage_.settings.acks != Acks::kNone) ack(frame->prefix.view, frame->prefix.sequence);
    const bool first = shownSeq_ == 0;
    settled_ = true;
    if (first) stats_.firstFrame.add(msSince(startedAt_));
    measure(frame->header.input_seq(), bytes.size());
    if (stage_.measuring && frame->header.has_pace()) pace(frame->header);
    if (kind_ != Kind::kJoin || !first) return;
    stage_.loop.at(Clock::now() + kStay, [this, mine = connection_] {
        if (greeted_ && mine == connection_) socket_->close();
    });
}

void ScriptedClient::measure(std::uint64_t inputSeq, std::size_t bytes) {
    if (stage_.measuring) {
        ++frames_;
        ++stats_.frames;
        stats_.bytes += bytes;
    }
    if (inputSeq <= shownSeq_) return;  // The same state again, as a better picture.
    if (stage_.measuring && shownSeq_ != 0) stats_.overtaken += inputSeq - shownSeq_ - 1;
    shownSeq_ = inputSeq;
    newAt_ = Clock::now();
    const auto sent = view_.sentAt.find(inputSeq);
    if (stage_.measuring && sent != view_.sentAt.end()) stats_.age.add(msSince(sent->second));
    while (!unanswered_.empty() && unanswered_.front().inputSeq <= inputSeq) {
        if (stage_.measuring) stats_.inputToFrame.add(msSince(unanswered_.front().at));
        unanswered_.pop_front();
    }
}

void ScriptedClient::pace(const v1::FrameHeader& header) {
    const double scale = header.pace().scale();
    stats_.leastScale = std::min(stats_.leastScale.value_or(scale), scale);
    if (header.codec() != v1::CODEC_JPEG) return;
    const std::uint32_t quality = header.pace().quality();
    stats_.leastQuality = std::min(stats_.leastQuality.value_or(quality), quality);
}

void ScriptedClient::countMissing() {
    const auto missing = std::exchange(unanswered_, {});
    const auto shown = std::exchange(shownSeq_, 0);
    if (!stage_.measuring) return;
    for (const Sent& one : missing) stats_.unanswered.add(msSince(one.at));
    if (shown == 0 && missing.empty()) return;
    // A newer state may overtake those that wait, but a picture is as old as it has stood still.
    const double still = msSince(newAt_);
    const auto& sent = view_.sentAt;
    for (auto one = sent.upper_bound(shown); one != sent.end(); ++one) {
        stats_.unseen.add(std::min(still, msSince(one->second)));
    }
}

void ScriptedClient::refused(const v1::Error& error) {
    if (sharing_ && view_.link.empty() && error.code() == v1::ERROR_CODE_MALFORMED_MESSAGE) {
        return stage_.giveUp("the server (protocol minor " + std::to_string(welcome_.minor()) +
                             ") does not know share_view, which --views needs: " + error.message());
    }
    settled_ = true;
    ++stats_.errors[v1::ErrorCode_Name(error.code())];
}

void ScriptedClient::closed(const std::string& why) {
    const bool wasOpen = std::exchange(greeted_, false);
    socket_.reset();
    countMissing();
    if (!why.empty()) {
        settled_ = true;
        ++(wasOpen ? stats_.lostConnections : stats_.failedConnects);
        ++stats_.errors[why];
    }
    if (opens_) view_.lost();
    stage_.loop.at(Clock::now() + (why.empty() ? kAway : kRetry), [this] { start(); });
}

void ScriptedClient::ack(std::uint32_t view, std::uint32_t sequence) {
    v1::ClientMessage message;
    message.mutable_ack()->set_view(view);
    message.mutable_ack()->set_sequence(sequence);
    // Two frames behind means slow, but no step down the ladder.
    if (stage_.settings.acks == Acks::kOneCredit) message.mutable_ack()->set_queue(2);
    send(message);
}

/// Gives back every credit, whether frames came or not.
void ScriptedClient::ackBlindly(std::uint64_t connection) {
    if (connection != connection_ || !greeted_) return;
    ack(kView, std::numeric_limits<std::uint32_t>::max());
    stage_.loop.at(Clock::now() + kBlindAck, [this, connection] { ackBlindly(connection); });
}

/// The quality that is wanted; and where acks do not say how fast frames may come, the rest as it
/// was at first, for good.
void ScriptedClient::pin() {
    v1::ClientMessage message;
    message.mutable_set_pins()->set_view(kView);
    v1::Pins& pins = *message.mutable_set_pins()->mutable_pins();
    pins.set_quality(stage_.settings.quality.value_or(90));
    if (stage_.settings.acks == Acks::kFull) return send(message);
    pins.set_scale(1);
    pins.set_frames_per_s(240);
    pins.set_full_accuracy(true);
    pins.set_codec(v1::CODEC_JPEG);
    send(message);
}

void ScriptedClient::send(const v1::ClientMessage& message) {
    if (socket_) socket_->send(message.SerializeAsString());
}

}  // namespace volcast::load
