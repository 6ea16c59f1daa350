#include "server/session/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace volcast::session {

namespace {

int scaled(int side, double scale) {
    return std::max(1, static_cast<int>(std::lround(side * scale)));
}

double ms(std::chrono::microseconds value) {
    return static_cast<double>(value.count()) / 1e3;
}

}  // namespace

Viewer::Viewer(Desc desc) : desc_{std::move(desc)} {
    setCodecs(desc_.codecs);
}

RenditionKey Viewer::wanted() const {
    if (resting_) return full();
    const PaceLevel level = pacing_.level();
    const double scale = pins_.scale ? level.scale : std::min(level.scale, drawLimit_.scale);
    return {.size = {scaled(desc_.size.x, scale), scaled(desc_.size.y, scale)},
            .fullAccuracy = level.fullAccuracy && (pins_.fullAccuracy || drawLimit_.fullAccuracy)};
}

void Viewer::setPins(const PacePins& pins, v1::Codec codec) {
    pinnedCodec_ = codec;
    pins_ = pins;
    PacePins all = pins;
    if (codec != v1::CODEC_UNSPECIFIED) all.video = isVideo(codec);
    pacing_.setPins(all);
}

void Viewer::setCodecs(const ClientCodecs& codecs) {
    desc_.codecs = codecs;
    pacing_.allowVideo(codecs.jpeg && codecs.video() != v1::CODEC_UNSPECIFIED);
}

void Viewer::input(TimePoint now) {
    lastInput_ = now;
    resting_ = false;
    // The idle frame is cancelled: what is compressed for it is not waited for.
    if (!encoding_ || !again_) return;
    encoding_.reset();
    exact_ = again_ = false;
}

void Viewer::rest(TimePoint now) {
    if (owesFull() && now >= calmAt()) resting_ = true;
}

void Viewer::moveTo(std::shared_ptr<Rendition> to) {
    rendition = std::move(to);
    video_ = {};
    exact_ = false;
    const auto& picture = rendition->picture();
    // What others were shown there is new to this viewer, unless it has seen a newer state.
    if (picture) taken_ = picture->number - (picture->header.input_seq() >= shownSeq_ ? 1 : 0);
}

bool Viewer::hasNewPicture() const {
    return rendition->picture() && rendition->picture()->number > taken_;
}

bool Viewer::waits() const {
    return rendition->wants() || hasNewPicture() || sendsAgain_;
}

bool Viewer::shows(const std::shared_ptr<const scene::Scene>& scene) const {
    return state == v1::VIEW_STATE_ACTIVE && rendition->settled() && !hasNewPicture() &&
           rendition->picture()->scene == scene && rendition->picture()->key == wanted() &&
           (exact_ || !isVideo(interactive().codec));
}

bool Viewer::owes() const {
    return owesLossless() || (owesFull() && rendition->picture());
}

bool Viewer::mayDraw(TimePoint now) const {
    const std::size_t ahead = (hasNewPicture() ? 1U : 0U) + (rendition->drawing() ? 1U : 0U);
    return pacing_.credit(ahead + (encoding_ ? 1 : 0), now) && now >= pacing_.nextStart();
}

bool Viewer::slowWay() const {
    return pacing_.level() != pacing_.best();
}

bool Viewer::owesLossless() const {
    return desc_.codecs.lossless(false) != v1::CODEC_UNSPECIFIED && !exact_ && !encoding_ &&
           !hasNewPicture() && rendition->settled() && rendition->picture()->header.ready() &&
           rendition->picture()->key == full();
}

TimePoint Viewer::calmAt() const {
    const auto roundTrips = pacing_.flow().roundTrip() * 3 / 2;
    const double rate = pacing_.flow().bytesPerS();
    const std::chrono::duration<double> transfer{
        rate > 0.0 ? static_cast<double>(losslessBytes_) / rate : 0.0};
    return lastInput_ +
           std::max({Clock::duration{kIdle}, Clock::duration{roundTrips},
                     std::chrono::duration_cast<Clock::duration>(
                         std::min<std::chrono::duration<double>>(transfer, kLongestIdle))});
}

Format Viewer::interactive() const {
    const PaceLevel level = pacing_.level();
    // At rest what is sent in full comes once: as good as it was before anything was given up.
    const int quality = resting_ ? pacing_.best().quality : level.quality;
    if (pinnedCodec_ != v1::CODEC_UNSPECIFIED) return {.codec = pinnedCodec_, .quality = quality};
    if (level.video && !resting_) return {.codec = desc_.codecs.video(), .quality = quality};
    if (desc_.codecs.jpeg) return {.codec = v1::CODEC_JPEG, .quality = quality};
    return {.codec = desc_.codecs.lossless(slowWay())};
}

std::shared_ptr<Encoding> Viewer::takeEncode(TimePoint now) {
    if (encoding_ || !credit(now)) return nullptr;
    Format format;
    if (hasNewPicture()) {
        if (now < pacing_.nextStart()) return nullptr;
        format = interactive();
        taken_ = rendition->picture()->number;
        again_ = false;
        pacing_.started(now);
    } else if (sendsAgain_ && rendition->settled()) {
        if (now < pacing_.nextStart()) return nullptr;
        format = exact_ ? Format{.codec = desc_.codecs.lossless(slowWay())} : interactive();
        again_ = true;
        pacing_.started(now);
    } else if (owesLossless() && now >= calmAt()) {
        format.codec = desc_.codecs.lossless(slowWay());
        again_ = true;
    } else {
        return nullptr;
    }
    exact_ = isLossless(format.codec);
    encoding_ = isVideo(format.codec) ? rendition->videoEncoding(format, video_)
                                      : rendition->encoding(format);
    return encoding_;
}

bool Viewer::encoded() {
    if (!encoding_->error) return true;
    const std::shared_ptr<Encoding> failed = std::exchange(encoding_, nullptr);
    if (!failed->group) return false;
    video_ = {};
    taken_ = failed->picture->number - 1;
    if (failed->error->code == ErrorCode::kTimeout) return true;  // It came too late.
    ClientCodecs others = desc_.codecs;
    others.giveUp(failed->format.codec);
    setCodecs(others);
    if (pinnedCodec_ == failed->format.codec) setPins(pins_, v1::CODEC_UNSPECIFIED);
    return true;
}

v1::Pace Viewer::paceOf(const Encoding& encoding, TimePoint now) const {
    const PaceReport report = pacing_.report(now);
    v1::Pace pace;
    if (!isLossless(encoding.format.codec)) {
        pace.set_quality(static_cast<std::uint32_t>(encoding.format.quality));
    }
    const RenditionKey& key = encoding.picture->key;
    pace.set_scale(static_cast<double>(key.size.x) / desc_.size.x);
    pace.set_full_accuracy(key.fullAccuracy);
    pace.set_frames_per_s(report.level.framesPerS);
    pace.set_window(static_cast<std::uint32_t>(report.window));
    pace.set_under_way(static_cast<std::uint32_t>(report.underWay + 1));
    pace.set_rtt_ms(ms(report.roundTrip));
    pace.set_rtt_min_ms(ms(report.shortestRoundTrip));
    pace.set_queue_delay_ms(ms(report.queueDelay));
    pace.set_bytes_per_s(report.bytesPerS);
    const bool limited = !whyLimited_.empty() && key != full();
    const char* between = limited && !report.reason.empty() ? "; " : "";
    pace.set_reason(report.reason + between + (limited ? whyLimited_ : ""));
    return pace;
}

v1::FrameHeader Viewer::headerOf(const Encoding& encoding, TimePoint now) const {
    v1::FrameHeader header = encoding.picture->header;
    const RenditionKey& key = encoding.picture->key;
    if (key == wanted() || key == full()) {
        header.set_input_seq(std::max(header.input_seq(), resizedBy_));
    }
    if (encoding.picture->scene == stays_.scene) {
        header.set_input_seq(std::max(header.input_seq(), stays_.seq));
    }
    header.set_codec(encoding.format.codec);
    header.set_lossless(isLossless(encoding.format.codec));
    header.set_keyframe(encoding.group && encoding.keyframe);
    if (header.lossless()) header.set_pixels_xxh32(encoding.pixelHash);
    const bool best = header.lossless() || desc_.codecs.lossless(false) == v1::CODEC_UNSPECIFIED;
    header.set_final(header.ready() && best && key == full());
    if (again_) {
        header.set_redrawn(false);
        header.clear_timings();
    }
    header.mutable_timings()->set_encode_ms(encoding.encodeMs);
    header.mutable_timings()->set_queue_ms(
        std::chrono::duration<double, std::milli>(now - encoding.at).count());
    *header.mutable_pace() = paceOf(encoding, now);
    return header;
}

std::optional<ReadyFrame> Viewer::takeFrame(TimePoint now) {
    if (!encoding_ || !encoding_->done) return std::nullopt;
    ReadyFrame frame{
        .sequence = ++sequence_, .header = headerOf(*encoding_, now), .payload = encoding_->bytes};
    shownSeq_ = encoding_->picture->header.input_seq();
    if (frame.header.lossless()) losslessBytes_ = frame.payload->size();
    if (sent_.size() >= kSentKept) sent_.pop_front();
    sent_.push_back({.inputSeq = frame.header.input_seq(),
                     .size = encoding_->picture->pixels->size,
                     .scene = encoding_->picture->scene});
    if (frame.header.input_seq() >= stays_.seq) sendsAgain_ = false;
    encoding_.reset();
    again_ = false;
    pacing_.sent(frame.sequence, frame.payload->size(), now);
    return frame;
}

void Viewer::acked(const FrameAck& ack, TimePoint now) {
    pacing_.acked(ack, now);
    if (ack.keyframe) video_ = {};
}

void Viewer::tick(TimePoint now) {
    if (!credit(now) && (waits() || owes())) pacing_.forgiveSilence(now);
}

std::optional<TimePoint> Viewer::deadline(TimePoint now) const {
    if (!waits() && !owes()) return std::nullopt;
    if (!credit(now) && !encoding_) return pacing_.flow().probeAt();
    if (waits() && now < pacing_.nextStart()) return pacing_.nextStart();
    if (owes()) return calmAt();
    return std::nullopt;
}

}  // namespace volcast::session
