#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"
#include "server/session/catalogue.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// What an accepted message or a change of data did to a view.
enum class SceneChange {
    kNone,     ///< Nothing to draw: an old update, or news about other data.
    kSame,     ///< A newer update, but of what the scene is already.
    kDraw,     ///< There is something new to draw.
    kWaiting,  ///< The new scene needs data that is being imported; the old one stays.
};

/// Errors: kInvalidArgument for a side out of range, kLimitExceeded for too many pixels, with
/// `field` relative to the message.
Result<scene::PictureSize> sizeFrom(const v1::Viewport& message, std::uint64_t maxPixels);

/// Reads a scene that is to be drawn at once. Errors: as sceneFrom() and scene::validate();
/// kNotFound for data that is unknown or not loaded; `field` relative to the scene.
Result<scene::Scene> readyScene(const v1::Scene& message, Catalogue& catalogue);

/// What one view shows: its last good scene, and the one that waits for data.
///
/// Every method either succeeds or leaves all as it was.
class ViewScene {
public:
    explicit ViewScene(Catalogue& catalogue) : catalogue_{catalogue} {}

    /// Errors: as sceneFrom() and scene::validate(), with `field` relative to the message;
    /// kNotFound for unknown data.
    Result<SceneChange> open(const v1::OpenView& message);
    Result<SceneChange> update(const v1::Update& message);
    /// Takes a whole scene, as an update of number `seq` would.
    Result<SceneChange> put(scene::Scene scene, std::uint64_t seq);
    /// An update that changes nothing of the scene; false for an old one.
    bool advance(std::uint64_t seq);

    /// Reacts to news about `id`. Errors: kIo with the importer's words where the view waits for
    /// it in vain; as scene::validate() where the scene does not suit the data that came.
    Result<SceneChange> datasetChanged(const std::string& id);

    /// A picture of the input `seq` was drawn: scene() may be gone back to.
    void drawn(std::uint64_t seq);
    /// After a failure that the scene is to blame for: takes the last scene that was drawn, seen by
    /// the newest camera. Where this one was, its code has failed later: the last scene that was
    /// drawn with other code, or with none; and where there was none, this one without its layers
    /// that run code. The input that brought the failed one; nothing where there is no other.
    std::optional<std::uint64_t> revert();

    [[nodiscard]] const std::optional<scene::Scene>& scene() const noexcept { return scene_; }
    [[nodiscard]] bool waiting() const noexcept { return waiting_.has_value(); }
    /// Datasets of scene() and of the one that waits.
    [[nodiscard]] std::vector<std::string> datasets() const;
    /// Of the newest update.
    [[nodiscard]] std::uint64_t inputSeq() const noexcept { return inputSeq_; }
    /// Newest update that a picture of scene() shows.
    [[nodiscard]] std::uint64_t shownSeq() const noexcept {
        return waiting_ ? waiting_->seqBefore : inputSeq_;
    }
    /// Sum of the versions of the scene's datasets: grows when one is imported again.
    [[nodiscard]] std::uint64_t dataVersion() const;

private:
    /// A scene whose data is not all there; `defaultOf` names the dataset where the client gave
    /// none.
    struct Waiting {
        std::optional<scene::Scene> scene = {};
        std::string defaultOf = {};
        std::optional<scene::Camera> camera = {};  ///< Replaces the default scene's.
        std::uint64_t seqBefore = 0;
        [[nodiscard]] std::vector<std::string> datasets() const;
    };
    /// Asks for the data of `next`; true where all of it is loaded.
    Result<bool> require(const Waiting& next);
    Result<scene::Scene> resolve(const Waiting& next) const;
    void take(scene::Scene scene);
    /// Holds the data of all scenes that may be shown without being asked for again.
    void hold();
    /// Takes `next` as the scene, or lets it wait.
    Result<SceneChange> accept(Waiting next);

    Catalogue& catalogue_;
    std::optional<scene::Scene> scene_;
    std::optional<scene::Scene> good_;   ///< The last one that was drawn.
    std::optional<scene::Scene> other_;  ///< The last one with other code.
    bool isGood_ = false;                ///< That is scene_, the camera aside.
    std::uint64_t sceneSeq_ = 0;         ///< Input that brought scene_.
    std::optional<Waiting> waiting_;
    DatasetHold hold_;
    std::uint64_t inputSeq_ = 0;
    std::uint64_t seenVersion_ = 0;  ///< dataVersion() when scene_ last changed or was drawn anew.
};

}  // namespace volcast::session
