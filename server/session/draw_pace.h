#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace volcast::session {

/// How much of a moving picture is given up.
struct DrawLevel {
    bool fullAccuracy = true;  ///< Drawn as the scene's accuracy asks; else as fast as possible.
    double scale = 1.0;        ///< Of the picture's sides.
    bool operator==(const DrawLevel&) const = default;
};

/// Keeps pictures of a view that moves within kWantedMs of drawing, whatever their size and model:
/// from what pictures cost, the best DrawLevel whose picture is expected to hold it.
///
/// Accuracy goes first, where that makes pictures cheaper: an error of a few 1/255 is seen less
/// than a coarser grid. Then the sides, down to a quarter and to kSmallestSide. A level is left for
/// a worse one where it takes a third longer than wanted, and for a better one that takes a
/// third less, so that noise does not change it. A view left alone is drawn in full.
///
/// What a pixel costs is the smaller of the last two pictures': the first one of a scene builds
/// programs. Has no clock; one of its view's, so that viewers of one size agree.
class DrawPace {
public:
    static constexpr double kWantedMs = 50.0;
    static constexpr int kSmallestSide = 256;  ///< Pixels, of the longer side.

    /// A picture of `size` took so long, at full accuracy or fast. True where that changes what
    /// any size is drawn at.
    bool drawn(scene::PictureSize size, bool fullAccuracy, double ms);
    /// Of pictures that are `full` when nothing is given up.
    [[nodiscard]] DrawLevel level(scene::PictureSize full);
    /// Why it is not the best, such as "a picture takes 130 ms"; empty where it is.
    [[nodiscard]] std::string reason(scene::PictureSize full) const;

private:
    static constexpr std::size_t kMostSizes = 64;

    class Cost {
    public:
        void add(double msPerPixel);
        [[nodiscard]] std::optional<double> msPerPixel() const;

    private:
        std::array<double, 2> last_{};
        std::size_t count_ = 0;
    };
    struct Size {
        int x = 0, y = 0;
        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads it.
        auto operator<=>(const Size&) const = default;
    };

    /// The best first.
    [[nodiscard]] std::vector<DrawLevel> levels(int longerSide) const;
    [[nodiscard]] DrawLevel choose(Size full, const DrawLevel& now) const;
    [[nodiscard]] bool fastPays() const;

    Cost full_, fast_;
    std::map<Size, DrawLevel> levels_;  ///< By full size.
};

}  // namespace volcast::session
