#include "server/session/viewer.h"

#include <algorithm>
#include <utility>

namespace volcast::session {

void Viewer::input(TimePoint now) {
    lastInput_ = now;
    // The idle frame is cancelled: what is compressed for it is not waited for.
    if (!encoding_ || !again_) return;
    encoding_.reset();
    exact_ = again_ = false;
}

bool Viewer::hasNewPicture() const {
    return rendition->picture() && rendition->picture()->number > taken_;
}

bool Viewer::mayDraw(TimePoint now) const {
    const std::size_t ahead = (hasNewPicture() ? 1U : 0U) + (rendition->drawing() ? 1U : 0U);
    return committed() + ahead < flow_.window(now);
}

bool Viewer::owesLossless() const {
    return desc_.codecs.jpeg && desc_.codecs.png && !exact_ && !encoding_ && !hasNewPicture() &&
           rendition->settled() && rendition->picture()->header.ready();
}

TimePoint Viewer::calmAt() const {
    const auto roundTrips = flow_.roundTrip() * 3 / 2;
    return lastInput_ + std::max<Clock::duration>(kIdle, roundTrips);
}

std::shared_ptr<Encoding> Viewer::takeEncode(TimePoint now) {
    if (encoding_ || !credit(now)) return nullptr;
    if (hasNewPicture()) {
        taken_ = rendition->picture()->number;
        exact_ = !desc_.codecs.jpeg;
        again_ = false;
    } else if (owesLossless() && now >= calmAt()) {
        exact_ = again_ = true;
    } else {
        return nullptr;
    }
    encoding_ = rendition->encoding({.codec = exact_ ? v1::CODEC_PNG : v1::CODEC_JPEG});
    return encoding_;
}

bool Viewer::encoded() {
    if (!encoding_->error) return true;
    encoding_.reset();
    return false;
}

v1::FrameHeader Viewer::headerOf(const Encoding& encoding, TimePoint now) const {
    v1::FrameHeader header = encoding.picture->header;
    const bool wantedSize = encoding.picture->pixels->size == desc_.size;
    if (wantedSize) header.set_input_seq(std::max(header.input_seq(), resizedBy_));
    header.set_codec(encoding.format.codec);
    header.set_lossless(encoding.format.codec == v1::CODEC_PNG);
    header.set_final(header.ready() && (header.lossless() || !desc_.codecs.png));
    if (again_) {
        header.set_redrawn(false);
        header.clear_timings();
    }
    header.mutable_timings()->set_encode_ms(encoding.encodeMs);
    header.mutable_timings()->set_queue_ms(
        std::chrono::duration<double, std::milli>(now - encoding.at).count());
    return header;
}

std::optional<ReadyFrame> Viewer::takeFrame(TimePoint now) {
    if (!encoding_ || !encoding_->done) return std::nullopt;
    ReadyFrame frame{
        .sequence = ++sequence_, .header = headerOf(*encoding_, now), .payload = encoding_->bytes};
    if (sent_.size() >= kSentKept) sent_.pop_front();
    sent_.push_back({.inputSeq = frame.header.input_seq(),
                     .size = encoding_->picture->pixels->size,
                     .scene = encoding_->picture->scene});
    encoding_.reset();
    again_ = false;
    flow_.sent(frame.sequence, now);
    return frame;
}

void Viewer::tick(TimePoint now) {
    const bool blocked = !credit(now) && (rendition->wants() || hasNewPicture() || owesLossless());
    if (blocked) flow_.forgiveSilence(now);
}

std::optional<TimePoint> Viewer::deadline(TimePoint now) const {
    const bool owes = owesLossless();
    if (!rendition->wants() && !hasNewPicture() && !owes) return std::nullopt;
    if (!credit(now) && !encoding_) return flow_.probeAt();
    if (owes) return calmAt();
    return std::nullopt;
}

}  // namespace volcast::session
