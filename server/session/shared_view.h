#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/session/outbox.h"
#include "server/session/saved_view.h"
#include "server/session/scene_history.h"
#include "server/session/shared.h"
#include "server/session/view_accuracy.h"
#include "server/session/view_difference.h"
#include "server/session/view_people.h"
#include "server/session/view_scene.h"
#include "server/session/viewer.h"

namespace volcast::session {

/// A scene that several clients look at: who they are, and how it gets drawn for them. What two of
/// them want alike is drawn once and encoded once.
///
/// Any thread; calls of others are made without the view's lock (Outbox), and `wake` of viewers
/// too. At most one rendition is at the render service, so that a view has one turn there however
/// many sizes are wanted; a view without viewers has none.
class SharedView : public std::enable_shared_from_this<SharedView> {
public:
    /// `id`: unique in the server and hard to guess.
    static std::shared_ptr<SharedView> create(const ViewParts& parts, std::string id);
    SharedView(const SharedView&) = delete;
    SharedView& operator=(const SharedView&) = delete;
    SharedView(SharedView&&) = delete;
    SharedView& operator=(SharedView&&) = delete;
    ~SharedView() = default;

    [[nodiscard]] const std::string& id() const noexcept { return id_; }
    /// Its number at the render service.
    [[nodiscard]] std::uint64_t global() const noexcept { return global_; }
    /// Takes its first scene. Errors: as ViewScene::open.
    Result<void> open(const v1::OpenView& message);
    /// Takes what was saved; its people are away until then. The scene's data is asked for when
    /// somebody comes.
    void restore(const SavedView& saved, TimePoint until);
    /// What is to be saved, without tokens; empty before there is a scene.
    [[nodiscard]] std::optional<SavedView> save() const;
    /// Nothing is drawn or told from now on.
    void end();
    /// Nobody is in it, nor away from it.
    [[nodiscard]] bool abandoned(TimePoint now);
    /// Nobody in it is connected since then; empty where somebody is.
    [[nodiscard]] std::optional<TimePoint> emptySince() const;

    // Coming and going.
    /// Errors: kLimitExceeded for a view that is full.
    Result<ViewerId> join(Viewer::Desc desc, Member member, TimePoint now);
    /// As join(), of somebody who was in the view and whose connection was lost, or is taken over.
    /// Empty where there is no such person.
    std::optional<ViewerId> comeBack(Viewer::Desc desc, std::uint32_t person, TimePoint now);
    void leave(ViewerId viewer);
    /// The connection was lost; the person may come back until then.
    void lose(ViewerId viewer, TimePoint until);

    // One viewer's calls; of a viewer that is gone they do nothing. What is refused is told by mail
    // where no error is returned.
    /// Errors: as sizeFrom() and ViewScene::update.
    Result<void> update(ViewerId viewer, const v1::Update& message, TimePoint now);
    /// The viewer's round trip, smoothed; 0 where it is not known.
    std::chrono::microseconds acked(ViewerId viewer, const FrameAck& ack, TimePoint now);
    /// What pacing must not change of this viewer's frames; `codec` of interactive pictures.
    void setPins(ViewerId viewer, const PacePins& pins, v1::Codec codec, TimePoint now);
    /// More, or less, is known of what its client can show.
    void setCodecs(ViewerId viewer, const ClientCodecs& codecs);
    void undo(ViewerId viewer, const v1::Undo& message, TimePoint now);
    void takeControl(ViewerId viewer);
    void handOver(ViewerId viewer, std::uint32_t person);
    void askControl(ViewerId viewer, bool withdraw);
    void rename(ViewerId viewer, const std::string& name);
    /// Empty where the viewer may share the view, else why not.
    [[nodiscard]] std::string whyNotSharing(ViewerId viewer) const;
    std::optional<v1::ServerMessage> takeMail(ViewerId viewer);
    std::optional<ReadyFrame> takeFrame(ViewerId viewer, TimePoint now);
    void tick(ViewerId viewer, TimePoint now);
    [[nodiscard]] std::optional<TimePoint> deadline(ViewerId viewer, TimePoint now) const;
    [[nodiscard]] std::uint32_t framesSent(ViewerId viewer) const;
    /// News about a dataset. All viewers' clients hear of it; one bringing it is enough.
    void datasetChanged(ViewerId viewer, const std::string& dataset);

    // Of shared_view_tools.cpp. Errors: kNotFound, kUnsupported, kInvalidArgument with `field`.
    [[nodiscard]] Result<v1::Plan> explain(ViewerId viewer) const;
    Result<void> measure(ViewerId viewer, const v1::MeasureAccuracy& message);
    Result<void> measureDifference(ViewerId viewer, const v1::MeasureDifference& message);
    Result<void> pick(ViewerId viewer, const v1::Pick& message);
    /// Of shared_view_thumbnails.cpp. Errors: as readyScene(); kInvalidArgument and kLimitExceeded
    /// for a side, kUnsupported for a scene that runs code.
    Result<void> drawThumbnail(ViewerId viewer, const v1::DrawThumbnail& message);

    /// Work done since the view began.
    struct Counts {
        std::uint64_t drawsAsked = 0;
        std::uint64_t encodes = 0;
    };
    [[nodiscard]] Counts counts() const;

private:
    /// Holds the lock; then makes the calls that were put into the outbox.
    class Turn {
    public:
        explicit Turn(SharedView& view) : view_{view}, lock_{view.mutex_} {}
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        Turn(Turn&&) = delete;
        Turn& operator=(Turn&&) = delete;
        ~Turn() { view_.outbox_.flush(lock_); }

    private:
        SharedView& view_;
        std::unique_lock<std::mutex> lock_;
    };
    using Lock = std::lock_guard<std::mutex>;

    SharedView(const ViewParts& parts, std::string id);
    void route();

    // News of the render service and the encoders.
    void rendered(const workers::RenderedFrame& frame);
    void failed(std::uint64_t tag, const Error& error);
    void recovering();
    void encoded(const std::shared_ptr<Encoding>& encoding, Encoding done);
    void measured(std::uint64_t tag, const Result<accuracy::Measurement>& result);
    void picked(std::uint64_t tag, const Result<std::optional<scene::Picked>>& result);

    // The scene, shared_view.cpp. `author`: who did it, and knows; 0: nobody.
    bool answerAgain(Viewer& viewer, scene::PictureSize size, std::uint64_t resizedBy,
                     TimePoint now);
    void apply(SceneChange change, TimePoint now, ViewerId author, bool cameraOnly = false);
    [[nodiscard]] v1::ServerMessage sceneMessage(ViewerId author, bool cameraOnly) const;
    void tellScene(ViewerId author, bool cameraOnly);
    /// One viewer hears of the scene as it is, and of the newest input.
    void tellScene(Viewer& viewer);
    /// There is something new to save.
    void changed();
    void sceneNews(const std::string& dataset, TimePoint now);
    void refresh(TimePoint now);
    void tellOpened(ViewerId id);
    void tell(Viewer& viewer, v1::ServerMessage message);
    void setState(Viewer& viewer, v1::ViewState state, const std::string& text);
    void refuse(Viewer& viewer, const Error& error, v1::ErrorCode code);
    void wake(const Viewer& viewer);

    // People, shared_view_people.cpp.
    void seat(ViewerId id, Viewer::Desc desc, TimePoint now);
    void unseat(ViewerId id);
    void openRestored(TimePoint now);
    void expire(TimePoint now);
    void tellPeople();
    void peopleChanged(ViewerId steered);
    void tellRefusal(ViewerId id, const std::string& why, std::uint64_t inputSeq);

    // Drawing, shared_view_frames.cpp.
    void place(Viewer& viewer);
    void dropUnused();
    void advance(TimePoint now);
    void advance(Viewer& viewer, TimePoint now);
    bool encodeFor(Viewer& viewer, TimePoint now);
    /// What the viewer waits for could not be encoded; true where it takes another format.
    bool encodingFailed(Viewer& viewer, const Error& error);
    /// It has something to draw, and a viewer of it could soon be sent that.
    [[nodiscard]] bool isWanted(const std::shared_ptr<Rendition>& rendition, TimePoint now) const;
    /// All its viewers were left alone and shown what there is to see: nobody waits for it.
    [[nodiscard]] bool isPatient(const std::shared_ptr<Rendition>& rendition) const;
    [[nodiscard]] bool mayDraw(const std::shared_ptr<Rendition>& rendition, TimePoint now) const;
    void draw(const std::shared_ptr<Rendition>& rendition, TimePoint now);
    void settle(std::uint64_t tag);
    void pacedBy(const workers::RenderedFrame& frame, const RenditionKey& key);

    [[nodiscard]] Result<void> mayMeasure(ViewerId viewer) const;
    [[nodiscard]] v1::ServerMessage measureReport(bool ofAccuracy) const;
    void measureNext();
    void stopMeasuring(const std::string& why);
    void pickNext();
    void askPick(ViewerId viewer);
    void thumbnailNext();
    void askThumbnail(ViewerId viewer);
    void thumbnailDrawn(const workers::RenderedFrame& frame);
    void thumbnailFailed(std::uint64_t tag, const Error& error);
    void thumbnailEncoded(std::uint64_t tag, v1::Codec codec,
                          const Result<std::vector<std::byte>>& bytes);
    void tellThumbnail(v1::Thumbnail answer);
    void forgetThumbnails(ViewerId viewer);
    void dropThumbnails();
    /// Null where it is gone.
    [[nodiscard]] Viewer* find(ViewerId viewer) const;

    const ViewParts parts_;
    const std::string id_;
    const std::uint64_t global_;
    mutable std::mutex mutex_;  ///< Of all below.
    Outbox outbox_;
    bool ended_ = false;
    ViewScene scene_;
    DrawState state_;                    ///< Of scene_; its scene is null before the first.
    ViewerId author_ = 0;                ///< Whose change state_.scene is; 0: nobody's.
    std::optional<SavedView> restored_;  ///< Until somebody comes.
    SceneHistory history_;
    ViewPeople people_;
    std::optional<TimePoint> emptySince_;
    std::map<ViewerId, std::unique_ptr<Viewer>> viewers_;  ///< Of people who are connected.
    ViewerId lastViewer_ = 0;

    std::vector<std::shared_ptr<Rendition>> renditions_;  ///< The one drawn last is last.
    std::shared_ptr<Rendition> drawing_;  ///< Whose request is at the render service.
    bool drawsPatiently_ = false;         ///< That one.
    DrawPace drawPace_;
    std::uint64_t lastTag_ = 0;
    std::uint64_t lastPicture_ = 0;
    Counts counts_;

    std::map<const Rendition*, v1::Plan> plans_;  ///< Of the newest pictures.
    ViewAccuracy accuracy_;
    ViewDifference difference_;  ///< Runs in the place of accuracy_.
    ViewerId measures_ = 0;      ///< Who asked for what runs.
    struct Picking {
        v1::Pick asked;
        Viewer::Sent of;
    };
    std::map<ViewerId, Picking> picks_;  ///< The newest of each viewer.
    ViewerId picker_ = 0;                ///< Whose is at the render service; 0: nobody's.
    std::uint64_t pickTag_ = 0;
    struct Sketch {
        std::uint32_t request = 0;
        scene::Scene scene;
        scene::PictureSize size{1};
    };
    std::map<ViewerId, Sketch> thumbnails_;  ///< The newest of each viewer.
    ViewerId thumbnailOf_ = 0;               ///< Whose is under way; 0: nobody's.
    std::uint64_t thumbnailTag_ = 0;
    std::uint64_t thumbnailView_ = 0;  ///< At the render service; 0: none yet.
};

}  // namespace volcast::session
