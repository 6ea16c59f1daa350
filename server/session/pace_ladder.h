#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace volcast::session {

/// How a client's interactive pictures of a view are made.
struct PaceLevel {
    bool video = false;        ///< VP9 or H.264 in place of JPEG.
    int quality = 90;          ///< Of JPEG and video, in [1, 100].
    double scale = 1.0;        ///< Of the picture's sides.
    bool fullAccuracy = true;  ///< Drawn as the scene's accuracy asks; else as fast as possible.
    double framesPerS = 0.0;   ///< At most; 0: as many as can be drawn.
    bool operator==(const PaceLevel&) const = default;
};

/// What a client forbids to change; an empty member is left to the ladder.
struct PacePins {
    std::optional<int> quality = {};
    std::optional<double> scale = {};
    std::optional<double> framesPerS = {};
    std::optional<bool> fullAccuracy = {};
    std::optional<bool> video = {};
};

/// What is given up, in this order, where a connection or a client does not keep up: JPEG for video
/// (where the client has it), quality, scale, accuracy, rate. What is pinned has no steps.
class PaceLadder {
public:
    explicit PaceLadder(bool hasVideo = false) : hasVideo_{hasVideo} { build(); }

    /// Steps that were taken are kept, as far as they still exist.
    void setPins(const PacePins& pins);
    void allowVideo(bool hasVideo);

    /// One step; what it changed, such as "quality 90 to 75". Empty at the end of the ladder.
    std::string down();
    std::string up();
    /// The next step down makes pictures of fewer bytes, not fewer or less accurate ones.
    [[nodiscard]] bool downShrinks() const {
        return taken_ < steps_.size() && steps_[taken_].kind < Kind::kAccuracy;
    }
    /// The step that up() gives back made pictures of fewer bytes.
    [[nodiscard]] bool upGrows() const {
        return taken_ > 0 && steps_[taken_ - 1].kind < Kind::kAccuracy;
    }

    [[nodiscard]] PaceLevel level() const { return levelAt(taken_); }
    [[nodiscard]] PaceLevel best() const { return levelAt(0); }
    [[nodiscard]] std::size_t taken() const noexcept { return taken_; }
    [[nodiscard]] std::size_t steps() const noexcept { return steps_.size(); }

private:
    enum class Kind { kCodec, kQuality, kScale, kAccuracy, kRate };
    struct Step {
        Kind kind;
        double value;
    };
    void build();
    [[nodiscard]] PaceLevel levelAt(std::size_t taken) const;
    [[nodiscard]] std::string change(std::size_t from, std::size_t to) const;

    bool hasVideo_;
    PacePins pins_;
    std::vector<Step> steps_;
    std::size_t taken_ = 0;  ///< The first so many of steps_ are.
};

}  // namespace volcast::session
