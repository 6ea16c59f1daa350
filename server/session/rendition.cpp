#include "server/session/rendition.h"

#include <algorithm>
#include <utility>

#include "server/video/encoder.h"

namespace volcast::session {

namespace {

double msBetween(TimePoint from, TimePoint to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

void Rendition::change(RenditionKey key) {
    if (key == key_) return;
    key_ = key;
    want();
}

void Rendition::want() {
    wanted_ = true;
    refines_ = false;
}

void Rendition::asked(std::uint64_t tag, const DrawState& state, TimePoint now) {
    Asked& asked = asked_.emplace_back(Asked{.tag = tag, .state = state, .key = key_, .at = now});
    if (refines_) asked.state.inputAt = now;
    wanted_ = refines_ = false;
    drawing_ = true;
}

bool Rendition::rendered(const workers::RenderedFrame& frame, std::uint64_t number) {
    const auto asked = std::ranges::find(asked_, frame.tag, &Asked::tag);
    if (asked == asked_.end() || !frame.picture) return false;
    if (frame.tag == asked_.back().tag) {
        drawing_ = false;
        if (!frame.ready && !wanted_) wanted_ = refines_ = true;
    }
    picture_ = std::make_shared<const ViewPicture>(ViewPicture{.number = number,
                                                               .key = asked->key,
                                                               .pixels = frame.picture,
                                                               .scene = asked->state.scene,
                                                               .header = headerOf(frame, *asked)});
    encodings_.clear();
    // Older requests cannot come back any more, but this one may: drawn again after a loss.
    asked_.erase(asked_.begin(), asked);
    return true;
}

v1::FrameHeader Rendition::headerOf(const workers::RenderedFrame& frame, const Asked& asked) {
    v1::FrameHeader header;
    header.set_input_seq(asked.state.inputSeq);
    header.set_width(static_cast<std::uint32_t>(frame.picture->size.x));
    header.set_height(static_cast<std::uint32_t>(frame.picture->size.y));
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
    timings.set_wait_ms(msBetween(asked.state.inputAt, asked.at) + frame.waitMs);
    timings.set_upload_ms(frame.uploadMs);
    timings.set_draw_ms(frame.drawMs);
    timings.set_readback_ms(frame.readbackMs + frame.copyMs);
    header.set_data_version(asked.state.dataVersion);
    header.set_worker_generation(frame.generation);
    header.set_redrawn(frame.drawn);
    return header;
}

bool Rendition::failed(std::uint64_t tag, bool& newest) {
    if (std::ranges::find(asked_, tag, &Asked::tag) == asked_.end()) return false;
    newest = tag == asked_.back().tag;
    std::erase_if(asked_, [tag](const Asked& asked) { return asked.tag <= tag; });
    if (newest) drawing_ = false;
    return true;
}

std::shared_ptr<Encoding> Rendition::encoding(const Format& format) {
    const auto found =
        std::ranges::find(encodings_, format, [](const auto& one) { return one->format; });
    if (found != encodings_.end()) return *found;
    return encodings_.emplace_back(
        std::make_shared<Encoding>(Encoding{.picture = picture_, .format = format}));
}

std::shared_ptr<Encoding> Rendition::videoEncoding(const Format& format, InVideo& viewer) {
    const auto begin = [&](std::shared_ptr<VideoGroup> group, bool keyframe) {
        viewer.group = std::move(group);
        const std::uint64_t after = std::exchange(viewer.group->last, picture_->number);
        viewer.last = picture_->number;
        return encodings_.emplace_back(std::make_shared<Encoding>(Encoding{.picture = picture_,
                                                                           .format = format,
                                                                           .group = viewer.group,
                                                                           .after = after,
                                                                           .keyframe = keyframe}));
    };
    const bool goesOn = viewer.group && viewer.group->format == format;
    const auto found = [&](auto suits) {
        return std::ranges::find_if(encodings_, [&](const auto& one) {
            return one->group && one->format == format && !one->error && suits(*one);
        });
    };
    const auto join = [&](const std::shared_ptr<Encoding>& one) {
        viewer = {.group = one->group, .last = picture_->number, .alone = false};
        return one;
    };
    if (goesOn) {
        const auto next = found([&](const Encoding& one) {
            return one.group == viewer.group && one.after == viewer.last;
        });
        if (next != encodings_.end()) return join(*next);
        if (viewer.group->last == viewer.last) return begin(viewer.group, false);
    }
    const auto keyframe = found([](const Encoding& one) { return one.keyframe; });
    if (keyframe != encodings_.end()) return join(*keyframe);
    viewer.alone = viewer.alone || goesOn;
    std::erase_if(groups_, [](const auto& group) { return group.expired(); });
    if (!viewer.alone) {
        for (const auto& weak : groups_) {
            auto group = weak.lock();
            if (!group || group->format != format || group->last >= picture_->number) continue;
            return begin(std::move(group), true);
        }
    }
    auto group = std::make_shared<VideoGroup>(format);
    if (!viewer.alone) groups_.push_back(group);
    return begin(std::move(group), true);
}

Result<std::vector<std::byte>> compress(const video::ImageView& image, const Format& format) {
    switch (format.codec) {
        case v1::CODEC_PNG: return video::encodePng(image);
        case v1::CODEC_WEBP: return video::encodeWebp(image);
        default: return video::encodeJpeg(image, format.quality);
    }
}

Encoding encode(const Encoding& encoding) {
    Encoding done = encoding;
    done.begun = done.done = true;
    const auto start = Clock::now();
    const workers::Picture& pixels = *encoding.picture->pixels;
    const video::ImageView image{.size = pixels.size, .rgba = pixels.rgba8};
    Result<std::vector<std::byte>> bytes = Error{};
    if (encoding.group) {
        auto picture = encoding.group->encode(image, encoding.picture->number, encoding.keyframe);
        if (picture) done.keyframe = picture->keyframe;
        if (picture) {
            bytes = std::move(picture->bytes);
        } else {
            bytes = std::move(picture).error();
        }
    } else {
        bytes = compress(image, encoding.format);
        if (isLossless(encoding.format.codec)) done.pixelHash = video::pixelHash(image);
    }
    done.at = Clock::now();
    done.encodeMs = msBetween(start, done.at);
    if (bytes) {
        done.bytes = std::make_shared<const std::vector<std::byte>>(std::move(*bytes));
    } else {
        done.error = bytes.error();
    }
    return done;
}

}  // namespace volcast::session
