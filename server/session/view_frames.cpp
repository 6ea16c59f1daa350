#include "server/session/view_frames.h"

#include <algorithm>
#include <utility>

#include "server/video/encoder.h"

namespace volcast::session {

namespace {

/// Requests whose answer may still come. When so many were overtaken while one is drawn, newer
/// states wait here instead: forgetting the one that is drawn would throw its picture away.
constexpr std::size_t kMaxAsked = 256;

double msBetween(TimePoint from, TimePoint to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

EncodedPicture encode(const EncodeTask& task) {
    EncodedPicture done{.task = task.number, .header = task.header, .bytes = {}};
    const auto start = Clock::now();
    const video::ImageView image{.size = task.picture->size, .rgba = task.picture->rgba8};
    auto bytes =
        task.header.codec() == v1::CODEC_PNG ? video::encodePng(image) : video::encodeJpeg(image);
    done.at = Clock::now();
    done.header.mutable_timings()->set_encode_ms(msBetween(start, done.at));
    if (bytes) {
        done.bytes = std::move(*bytes);
    } else {
        done.error = bytes.error();
    }
    return done;
}

void ViewFrames::want(DrawState state) {
    wanted_ = std::move(state);
}

void ViewFrames::input(TimePoint now) {
    lastInput_ = now;
    // The idle picture is cancelled: the result of a running job is not waited for.
    if (encoding_ && encodingExact_) encoding_.reset();
    if (encoded_ && encodingExact_) encoded_.reset();
    if (encodingExact_) {
        encodingExact_ = false;
        exact_ = false;
    }
}

std::size_t ViewFrames::committed() const {
    return flow_.underWay() + (encoding_ || encoded_ ? 1 : 0);
}

std::optional<DrawState> ViewFrames::takeDraw(TimePoint now, std::uint64_t& tag) {
    if (!wanted_ || asked_.size() >= kMaxAsked) return std::nullopt;
    const std::size_t ahead = (picture_ ? 1U : 0U) + (drawing_ ? 1U : 0U);
    if (committed() + ahead >= flow_.window(now)) return std::nullopt;
    tag = ++lastTag_;
    asked_.push_back({.tag = tag,
                      .inputSeq = wanted_->inputSeq,
                      .dataVersion = wanted_->dataVersion,
                      .inputAt = wanted_->refines ? now : wanted_->inputAt,
                      .at = now});
    drawing_ = true;
    newest_.reset();
    newest_.swap(wanted_);
    return newest_;
}

bool ViewFrames::rendered(const workers::RenderedFrame& frame) {
    const auto asked = std::ranges::find(asked_, frame.tag, &Asked::tag);
    if (asked == asked_.end() || !frame.picture) return false;
    if (frame.tag == lastTag_) {
        drawing_ = false;
        if (!frame.ready && !wanted_) {
            wanted_ = newest_;
            wanted_->refines = true;
        }
    }
    picture_ = Shown{.picture = frame.picture, .header = headerOf(frame, *asked)};
    // Older requests cannot come back any more, but this one may: drawn again after a loss.
    asked_.erase(asked_.begin(), asked);
    return true;
}

v1::FrameHeader ViewFrames::headerOf(const workers::RenderedFrame& frame,
                                     const Asked& asked) const {
    v1::FrameHeader header;
    header.set_input_seq(asked.inputSeq);
    header.set_width(static_cast<std::uint32_t>(frame.picture->size.x));
    header.set_height(static_cast<std::uint32_t>(frame.picture->size.y));
    header.set_codec(codecs_.jpeg ? v1::CODEC_JPEG : v1::CODEC_PNG);
    header.set_lossless(!codecs_.jpeg);
    header.set_final(frame.ready && !(codecs_.jpeg && codecs_.png));
    header.set_ready(frame.ready);
    header.set_plan_id(frame.plan.id);
    for (const plan::LayerPlan& layer : frame.plan.layers) {
        if (layer.drawn) header.add_integrators(layer.integrator);
    }
    // The worst of the errors that were measured.
    for (const plan::LayerPlan& layer : frame.plan.layers) {
        if (!layer.errorBound) continue;
        header.set_estimated_error(std::max(header.estimated_error(), *layer.errorBound));
    }
    v1::Timings& timings = *header.mutable_timings();
    timings.set_wait_ms(msBetween(asked.inputAt, asked.at) + frame.waitMs);
    timings.set_upload_ms(frame.uploadMs);
    timings.set_draw_ms(frame.drawMs);
    timings.set_readback_ms(frame.readbackMs + frame.copyMs);
    header.set_data_version(asked.dataVersion);
    header.set_worker_generation(frame.generation);
    header.set_redrawn(frame.drawn);
    return header;
}

bool ViewFrames::failed(std::uint64_t tag) {
    std::erase_if(asked_, [tag](const Asked& asked) { return asked.tag <= tag; });
    if (tag != lastTag_) return false;
    drawing_ = false;
    return true;
}

bool ViewFrames::owesLossless() const {
    return codecs_.jpeg && codecs_.png && shown_ && shown_->header.ready() && !exact_ && !wanted_ &&
           !drawing_ && !picture_ && !encoding_ && !encoded_;
}

TimePoint ViewFrames::calmAt() const {
    const auto roundTrips = flow_.roundTrip() * 3 / 2;
    return lastInput_ + std::max<Clock::duration>(kIdle, roundTrips);
}

std::optional<EncodeTask> ViewFrames::takeEncode(TimePoint now) {
    if (encoding_ || encoded_ || !credit(now)) return std::nullopt;
    EncodeTask task;
    if (picture_) {
        shown_.swap(picture_);
        picture_.reset();
        exact_ = !codecs_.jpeg;
        encodingExact_ = false;
        task.header = shown_->header;
    } else if (owesLossless() && now >= calmAt()) {
        exact_ = encodingExact_ = true;
        task.header = shown_->header;
        task.header.set_codec(v1::CODEC_PNG);
        task.header.set_lossless(true);
        task.header.set_final(true);
        task.header.set_redrawn(false);
        task.header.clear_timings();
    } else {
        return std::nullopt;
    }
    task.number = ++lastTask_;
    task.picture = shown_->picture;
    encoding_ = task.number;
    return task;
}

std::optional<Error> ViewFrames::encoded(EncodedPicture picture) {
    if (encoding_ != picture.task) return std::nullopt;  // Cancelled by an input.
    encoding_.reset();
    if (picture.error) return picture.error;
    encoded_ = std::move(picture);
    return std::nullopt;
}

std::optional<ReadyFrame> ViewFrames::takeFrame(TimePoint now) {
    if (!encoded_) return std::nullopt;
    encodingExact_ = false;
    ReadyFrame frame{.sequence = ++sequence_,
                     .header = std::move(encoded_->header),
                     .payload = std::move(encoded_->bytes)};
    frame.header.mutable_timings()->set_queue_ms(msBetween(encoded_->at, now));
    encoded_.reset();
    flow_.sent(frame.sequence, frame.payload.size(), now);
    return frame;
}

void ViewFrames::tick(TimePoint now) {
    const bool blocked = !credit(now) && (wanted_ || picture_ || owesLossless());
    if (blocked) flow_.forgiveSilence(now);
}

std::optional<TimePoint> ViewFrames::deadline(TimePoint now) const {
    const bool owes = owesLossless();
    if (!wanted_ && !picture_ && !owes) return std::nullopt;
    if (!credit(now) && !encoding_ && !encoded_) return flow_.probeAt();
    if (owes) return calmAt();
    return std::nullopt;
}

}  // namespace volcast::session
