#include "server/session/view_accuracy.h"

#include <algorithm>

#include "renderer/worker/scene_message.h"

namespace volcast::session {
namespace {

bool beats(const v1::AccuracyRow& a, const v1::AccuracyRow& b) {
    const bool noWorse = a.rms_error() <= b.rms_error() && a.median_ms() <= b.median_ms();
    return noWorse && (a.rms_error() < b.rms_error() || a.median_ms() < b.median_ms());
}

void put(const accuracy::Measurement& found, v1::AccuracyRow& row) {
    row.set_max_error(found.all.max);
    row.set_rms_error(found.all.rms);
    row.set_share_over_255(found.all.share255);
    row.set_share_over_65535(found.all.share65535);
    row.set_median_ms(found.medianMs);
    row.set_min_ms(found.minMs);
    row.set_max_ms(found.maxMs);
    row.set_cells_per_ray(found.cellsPerRay);
}

}  // namespace

void ViewAccuracy::start(const scene::Scene& scene, scene::PictureSize size, std::uint64_t pixels,
                         const std::set<std::string>& volumes) {
    scene_ = scene;
    size_ = size;
    pixels_ = pixels == 0 ? kUsualPixels : std::min(pixels, kMostPixels);
    candidates_ = accuracy::candidates(scene, volumes);
    rows_.clear();
    ++tag_;
    aim_ = accuracy::Aim::kCandidate;
    refusal_.clear();
    without_.clear();
    times_.clear();
    pictureMs_.reset();
    running_ = !candidates_.empty();
}

void ViewAccuracy::startEstimates(const scene::Scene& scene, scene::PictureSize size) {
    start(scene, size, 0, {});
    if (!running_) return;
    aim_ = accuracy::Aim::kEstimates;
    scene_.accuracy = {.kind = scene::Accuracy::Kind::kErrorBound, .bound = 1.0};
    for (scene::Layer& layer : scene_.layers) layer.integrator = scene::Integrator::kAuto;
}

accuracy::Job ViewAccuracy::job(std::uint64_t& tag) const {
    tag = tag_;
    if (aim_ == accuracy::Aim::kEstimates) return {.scene = scene_, .size = size_, .aim = aim_};
    if (aim_ == accuracy::Aim::kTime) {
        return {.scene = pictureMs_ ? without_.at(times_.size()).scene : scene_,
                .size = size_,
                .aim = aim_,
                .frames = kEffectFrames};
    }
    return {.scene = scene_,
            .size = size_,
            .candidate = candidates_.at(rows_.size()),
            .frames = kFrames,
            .pixels = pixels_};
}

bool ViewAccuracy::measured(std::uint64_t tag, const Result<accuracy::Measurement>& result) {
    if (!running_ || tag != tag_) return false;
    ++tag_;
    switch (aim_) {
        case accuracy::Aim::kTime: takeTime(result); break;
        case accuracy::Aim::kEstimates:
            if (result) takeEstimates(result->estimates);
            if (!result) refusal_ = result.error().message;
            running_ = false;
            break;
        default: take(result); running_ = rows_.size() < candidates_.size();
    }
    return true;
}

void ViewAccuracy::startEffects(const scene::Scene& scene, scene::PictureSize size,
                                const v1::Plan& plan) {
    start(scene, size, 0, {});
    aim_ = accuracy::Aim::kTime;
    without_ = accuracy::withoutEffects(scene);
    std::erase_if(without_, [&plan](const accuracy::WithoutEffect& one) {
        for (const v1::LayerPlan& layer : plan.layers()) {
            if (layer.layer() != one.layer || !layer.drawn()) continue;
            return std::ranges::none_of(layer.effects(), [&one](const v1::Effect& effect) {
                return effect.on() && effect.name() == one.effect;
            });
        }
        return true;
    });
    running_ = true;
}

void ViewAccuracy::takeTime(const Result<accuracy::Measurement>& result) {
    if (!pictureMs_) {
        if (result) pictureMs_ = result->medianMs;
        if (!result) refusal_ = result.error().message;
        running_ = result.has_value() && !without_.empty();
        return;
    }
    const accuracy::WithoutEffect& without = without_.at(times_.size());
    v1::EffectTime& time = times_.emplace_back();
    time.set_layer(without.layer);
    time.set_effect(without.effect);
    if (result) time.set_ms(*pictureMs_ - result->medianMs);
    if (!result) time.set_refusal(result.error().message);
    running_ = times_.size() < without_.size();
}

double ViewAccuracy::progress() const {
    if (!running_ && aim_ != accuracy::Aim::kCandidate) return 1.0;
    const bool effects = aim_ == accuracy::Aim::kTime;
    const auto all = static_cast<double>(effects ? without_.size() + 1 : candidates_.size());
    const auto done =
        static_cast<double>(effects ? times_.size() + (pictureMs_ ? 1 : 0) : rows_.size());
    return all > 0.0 ? done / all : 1.0;
}

void ViewAccuracy::takeEstimates(const plan::SceneEvidence& estimates) {
    for (const scene::Layer& layer : scene_.layers) {
        const auto found = estimates.find(layer.id);
        if (found == estimates.end()) continue;
        for (const plan::Evidence& one : found->second) {
            if (!one.error) continue;
            v1::AccuracyRow& row = rows_.emplace_back();
            row.set_layer(layer.id);
            row.set_model(worker::toMessage(layer.model));
            row.set_integrator(worker::toMessage(one.integrator));
            row.set_max_error(*one.error / 255.0);
            row.set_median_ms(one.predictedMs.value_or(0.0));
        }
    }
}

void ViewAccuracy::take(const Result<accuracy::Measurement>& result) {
    const accuracy::Candidate& candidate = candidates_.at(rows_.size());
    const scene::Layer& layer = scene_.layers.at(candidate.layer);
    v1::AccuracyRow& row = rows_.emplace_back();
    row.set_layer(layer.id);
    row.set_model(worker::toMessage(layer.model));
    row.set_integrator(worker::toMessage(candidate.integrator));
    row.set_evaluator(worker::toMessage(candidate.evaluator));
    if (result) {
        put(*result, row);
    } else {
        row.set_refusal(result.error().message);
    }
}

v1::AccuracyReport ViewAccuracy::report(std::uint32_t view) const {
    v1::AccuracyReport report;
    report.set_view(view);
    report.set_done(!running_);
    report.set_estimated(aim_ == accuracy::Aim::kEstimates);
    report.set_stopped(refusal_);
    report.set_progress(progress());
    report.set_picture_ms(pictureMs_.value_or(0.0));
    for (const v1::EffectTime& time : times_) *report.add_effects() = time;
    for (const v1::AccuracyRow& row : rows_) {
        v1::AccuracyRow& added = *report.add_rows() = row;
        if (aim_ == accuracy::Aim::kEstimates) continue;  // Their mean errors are not known.
        added.set_on_front(row.refusal().empty() &&
                           std::ranges::none_of(rows_, [&row](const v1::AccuracyRow& other) {
                               return other.refusal().empty() && other.layer() == row.layer() &&
                                      beats(other, row);
                           }));
    }
    return report;
}

}  // namespace volcast::session
