#include "server/session/draw_pace.h"

#include <algorithm>
#include <cmath>

namespace volcast::session {

namespace {

constexpr std::array kScales{1.0, 0.75, 0.5, 0.35, 0.25};
/// Fast pictures that take more than this share of full ones give up accuracy for nothing.
constexpr double kWorthwhile = 0.8;
constexpr double kLeaveOver = 4.0 / 3.0;
constexpr double kRiseUnder = 2.0 / 3.0;

}  // namespace

void DrawPace::Cost::add(double msPerPixel) {
    last_.at(count_ % last_.size()) = msPerPixel;
    ++count_;
}

std::optional<double> DrawPace::Cost::msPerPixel() const {
    if (count_ < last_.size()) return std::nullopt;
    return std::ranges::min(last_);
}

bool DrawPace::fastPays() const {
    const auto full = full_.msPerPixel(), fast = fast_.msPerPixel();
    return !full || !fast || *fast < kWorthwhile * *full;  // Unknown: it is worth trying.
}

std::vector<DrawLevel> DrawPace::levels(int longerSide) const {
    std::vector<DrawLevel> levels{DrawLevel{}};
    const bool fast = fastPays();
    for (const double scale : kScales) {
        if (scale < 1.0 && std::lround(longerSide * scale) < kSmallestSide) break;
        if (scale < 1.0 || fast) levels.push_back({.fullAccuracy = !fast, .scale = scale});
    }
    return levels;
}

DrawLevel DrawPace::choose(Size full, const DrawLevel& now) const {
    const double pixels = static_cast<double>(full.x) * full.y;
    const std::vector<DrawLevel> all = levels(std::max(full.x, full.y));
    const auto current = std::ranges::find(all, now);
    for (auto level = all.begin(); level != all.end(); ++level) {
        const auto cost = (level->fullAccuracy ? full_ : fast_).msPerPixel();
        if (!cost) return *level;  // What is not known is tried.
        const double share = current == all.end() || level > current ? 1.0
                             : level == current                      ? kLeaveOver
                                                                     : kRiseUnder;
        const double ms = *cost * pixels * level->scale * level->scale;
        if (ms <= kWantedMs * share) return *level;
    }
    return all.back();
}

bool DrawPace::drawn(scene::PictureSize size, bool fullAccuracy, double ms) {
    const double pixels = static_cast<double>(size.x) * size.y;
    if (pixels <= 0.0) return false;
    (fullAccuracy ? full_ : fast_).add(ms / pixels);
    bool changed = false;
    for (auto& [full, level] : levels_) {
        const DrawLevel before = level;
        level = choose(full, before);
        changed = changed || level != before;
    }
    return changed;
}

DrawLevel DrawPace::level(scene::PictureSize full) {
    const Size key{.x = full.x, .y = full.y};
    const auto known = levels_.find(key);
    if (known != levels_.end()) return known->second;
    if (levels_.size() == kMostSizes) levels_.clear();
    return levels_[key] = choose(key, {});
}

std::string DrawPace::reason(scene::PictureSize full) const {
    const auto known = levels_.find(Size{.x = full.x, .y = full.y});
    if (known == levels_.end() || known->second == DrawLevel{}) return {};
    const auto cost = full_.msPerPixel();
    if (!cost) return {};
    return "a whole picture takes " +
           std::to_string(std::lround(*cost * static_cast<double>(full.x) * full.y)) +
           " ms to draw";
}

}  // namespace volcast::session
