#include "server/session/pace_ladder.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace volcast::session {

namespace {

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

std::string rate(double framesPerS) {
    return framesPerS == 0.0 ? "as drawn" : number(framesPerS) + " frames/s";
}

}  // namespace

void PaceLadder::build() {
    std::vector<Step> before;
    before.swap(steps_);
    before.resize(taken_);
    if (hasVideo_ && !pins_.video) steps_.push_back({Kind::kCodec, 1});
    if (!pins_.quality) {
        for (const double quality : {75.0, 60.0, 45.0}) steps_.push_back({Kind::kQuality, quality});
    }
    if (!pins_.scale) {
        for (const double scale : {0.75, 0.5}) steps_.push_back({Kind::kScale, scale});
    }
    if (!pins_.fullAccuracy) steps_.push_back({Kind::kAccuracy, 0});
    for (const double framesPerS : {15.0, 8.0, 4.0, 2.0}) {
        if (!pins_.framesPerS) steps_.push_back({Kind::kRate, framesPerS});
    }
    // Kinds are in order, and so are the values of one kind: all up to the last one stays taken.
    if (before.empty()) return;
    const Step last = before.back();
    taken_ = static_cast<std::size_t>(std::ranges::count_if(steps_, [&last](const Step& step) {
        return step.kind < last.kind || (step.kind == last.kind && step.value >= last.value);
    }));
}

void PaceLadder::setPins(const PacePins& pins) {
    pins_ = pins;
    build();
}

void PaceLadder::allowVideo(bool hasVideo) {
    hasVideo_ = hasVideo;
    build();
}

PaceLevel PaceLadder::levelAt(std::size_t taken) const {
    PaceLevel level{.video = hasVideo_ && pins_.video.value_or(false),
                    .quality = pins_.quality.value_or(90),
                    .scale = pins_.scale.value_or(1.0),
                    .fullAccuracy = pins_.fullAccuracy.value_or(true),
                    .framesPerS = pins_.framesPerS.value_or(0.0)};
    for (std::size_t i = 0; i < taken; ++i) {
        const Step& step = steps_[i];
        switch (step.kind) {
            case Kind::kCodec: level.video = true; break;
            case Kind::kQuality: level.quality = static_cast<int>(step.value); break;
            case Kind::kScale: level.scale = step.value; break;
            case Kind::kAccuracy: level.fullAccuracy = false; break;
            case Kind::kRate: level.framesPerS = step.value; break;
        }
    }
    return level;
}

std::string PaceLadder::change(std::size_t from, std::size_t to) const {
    const PaceLevel before = levelAt(from), after = levelAt(to);
    switch (steps_[std::min(from, to)].kind) {
        case Kind::kCodec: return after.video ? "JPEG to video" : "video to JPEG";
        case Kind::kQuality:
            return "quality " + number(before.quality) + " to " + number(after.quality);
        case Kind::kScale: return "scale " + number(before.scale) + " to " + number(after.scale);
        case Kind::kAccuracy:
            return after.fullAccuracy ? "fast to full accuracy" : "full accuracy to fast";
        case Kind::kRate:
            return "rate " + rate(before.framesPerS) + " to " + rate(after.framesPerS);
    }
    return {};
}

std::string PaceLadder::down() {
    if (taken_ == steps_.size()) return {};
    ++taken_;
    return change(taken_ - 1, taken_);
}

std::string PaceLadder::up() {
    if (taken_ == 0) return {};
    --taken_;
    return change(taken_ + 1, taken_);
}

}  // namespace volcast::session
