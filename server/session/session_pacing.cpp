// What a client can show, and what it forbids pacing to change.
#include <algorithm>
#include <cmath>
#include <utility>

#include <spdlog/spdlog.h>

#include "protocol/framing.h"
#include "renderer/base/printable.h"
#include "server/session/session.h"
#include "server/video/colour_patch.h"
#include "server/video/video_patches.h"

namespace volcast::session {

namespace {

constexpr std::uint32_t kLeastQuality = 30, kMostQuality = 100;
constexpr double kLeastScale = 0.25, kMostScale = 1.0;
constexpr double kLeastRate = 1.0, kMostRate = 240.0;

v1::Codec codecOf(video::VideoCodec codec) {
    return codec == video::VideoCodec::kVp9 ? v1::CODEC_VP9 : v1::CODEC_H264;
}

std::string nameOf(v1::Codec codec) {
    const std::string& name = v1::Codec_Name(codec);
    return name.empty() ? "codec " + std::to_string(codec) : name;
}

Result<void> within(double value, double least, double most, const char* field) {
    if (value >= least && value <= most) return {};
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: {} is outside [{}, {}]", field, value, least, most), field);
}

/// Errors: kInvalidArgument with `field` for a value out of its range.
Result<PacePins> pinsFrom(const v1::Pins& message) {
    PacePins pins;
    if (message.has_quality()) {
        const auto valid = within(message.quality(), kLeastQuality, kMostQuality, "pins.quality");
        if (!valid) return valid.error();
        pins.quality = static_cast<int>(message.quality());
    }
    if (message.has_scale()) {
        const auto valid = within(message.scale(), kLeastScale, kMostScale, "pins.scale");
        if (!valid) return valid.error();
        pins.scale = message.scale();
    }
    if (message.has_frames_per_s()) {
        const auto valid =
            within(message.frames_per_s(), kLeastRate, kMostRate, "pins.frames_per_s");
        if (!valid) return valid.error();
        pins.framesPerS = message.frames_per_s();
    }
    if (message.has_full_accuracy()) pins.fullAccuracy = message.full_accuracy();
    return pins;
}

}  // namespace

std::vector<v1::Codec> Session::codecsHere() {
    std::vector<v1::Codec> codecs{v1::CODEC_JPEG, v1::CODEC_PNG, v1::CODEC_WEBP};
    for (const video::VideoPatch& patch : video::videoPatches()) {
        codecs.push_back(codecOf(patch.codec));
    }
    return codecs;
}

Result<void> Session::takeCodecs(const v1::Hello& message) {
    if (message.codecs().empty()) return {};
    const auto shows = [&message](v1::Codec codec) {
        return std::ranges::count(message.codecs(), codec) != 0;
    };
    codecs_ = {
        .jpeg = shows(v1::CODEC_JPEG), .png = shows(v1::CODEC_PNG), .webp = shows(v1::CODEC_WEBP)};
    if (!codecs_.jpeg && !codecs_.png && !codecs_.webp) {
        return fail(ErrorCode::kUnsupported,
                    "a client must show JPEG, PNG or WebP; others come beside them",
                    "hello.codecs");
    }
    for (const video::VideoPatch& patch : video::videoPatches()) {
        if (shows(codecOf(patch.codec))) untried_.push_back(codecOf(patch.codec));
    }
    patches_ = {untried_.begin(), untried_.end()};
    return {};
}

std::optional<Outgoing> Session::nextPatch() {
    if (patches_.empty()) return std::nullopt;
    const v1::Codec codec = patches_.front();
    patches_.pop_front();
    const auto& all = video::videoPatches();
    const auto patch = std::ranges::find(
        all, codec, [](const video::VideoPatch& one) { return codecOf(one.codec); });
    const glm::ivec2 size = video::colourPatch().size;
    v1::FrameHeader header;
    header.set_codec(codec);
    header.set_width(static_cast<std::uint32_t>(size.x));
    header.set_height(static_cast<std::uint32_t>(size.y));
    header.set_keyframe(true);
    header.set_patch(true);
    return Outgoing{.text = false,
                    .head = protocol::encodeFrameHead(0, 0, header, form_ == Form::kJson),
                    .payload = std::make_shared<const std::vector<std::byte>>(patch->bytes)};
}

void Session::patchDecoded(const v1::PatchDecoded& message) {
    if (std::erase(untried_, message.codec()) == 0) {
        return send(
            errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                         "no colour patch in " + nameOf(message.codec()) + " waits for an answer",
                         {}, "patch_decoded.codec"));
    }
    Result<void> right = message.error().empty()
                             ? video::checkPatch(std::as_bytes(std::span{message.rgb()}))
                             : fail(ErrorCode::kUnsupported, message.error());
    spdlog::info(R"(event=patch connection={} codec={} passed={} message="{}")", number_,
                 nameOf(message.codec()), right.has_value(),
                 right ? "" : base::printable(right.error().message, 200));
    if (!right) return;
    (message.codec() == v1::CODEC_VP9 ? codecs_.vp9 : codecs_.h264) = true;
    for (const auto& [number, seat] : seats_) seat.view->setCodecs(seat.viewer, codecs_);
}

void Session::setPins(const v1::SetPins& message, TimePoint now) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const ErrorContext about{.view = message.view()};
    const auto pins = pinsFrom(message.pins());
    if (!pins) return send(errorMessage(pins.error(), about));
    const v1::Codec codec = message.pins().codec();
    if (codec != v1::CODEC_UNSPECIFIED && !codecs_.has(codec)) {
        return send(errorMessage(v1::ERROR_CODE_UNSUPPORTED,
                                 nameOf(codec) + " is not among the codecs that this client was "
                                                 "found to show",
                                 about, "pins.codec"));
    }
    seat->view->setPins(seat->viewer, *pins, codec, now);
}

}  // namespace volcast::session
